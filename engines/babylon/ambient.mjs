// Ambient occlusion of Babylon.js: its pipeline over a white image, so that the result is what it multiplies.
import {SSAO2RenderingPipeline} from '@babylonjs/core/PostProcesses/RenderPipeline/Pipelines/ssao2RenderingPipeline.js';
import '@babylonjs/core/PostProcesses/RenderPipeline/postProcessRenderPipelineManagerSceneComponent.js';
import '@babylonjs/core/Rendering/geometryBufferRendererSceneComponent.js';
import '@babylonjs/core/Rendering/prePassRendererSceneComponent.js';

/** Adds the pipeline; gives {dispose()}. */
export function add_occlusion(scene, camera, values) {
  const is_forced = values['force-geometry-buffer'];
  const pipeline = new SSAO2RenderingPipeline('ssao', scene, {ssaoRatio: values['ssao-ratio'], blurRatio: values['blur-ratio']},
                                              [camera], is_forced);
  Object.assign(pipeline, {
    radius: values.radius,
    totalStrength: values['total-strength'],
    base: values.base,
    samples: values.samples,
    epsilon: values.epsilon,
    maxZ: values['max-z'],
    minZAspect: values['min-z-aspect'],
    bypassBlur: values['bypass-blur'],
    expensiveBlur: values['expensive-blur'],
    bilateralSamples: values['bilateral-samples'],
    bilateralSoften: values['bilateral-soften'],
    bilateralTolerance: values['bilateral-tolerance'],
  });
  return {
    dispose() {
      pipeline.dispose(true);
      if (!is_forced) scene.disablePrePassRenderer();
    },
  };
}
