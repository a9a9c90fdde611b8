// Ambient occlusion of Babylon.js: its pipeline over a white image, so that the result is what it multiplies.
import {SSAO2RenderingPipeline} from '@babylonjs/core/PostProcesses/RenderPipeline/Pipelines/ssao2RenderingPipeline.js';
import '@babylonjs/core/PostProcesses/RenderPipeline/postProcessRenderPipelineManagerSceneComponent.js';
import '@babylonjs/core/Rendering/geometryBufferRendererSceneComponent.js';
import '@babylonjs/core/Rendering/prePassRendererSceneComponent.js';
import {settings_of} from '/browser/page.mjs';

/** Adds the pipeline; gives {dispose()}. */
export function add_occlusion(scene, camera, values) {
  const is_forced = values['ssao-force-geometry-buffer'];
  const ratio = {ssaoRatio: values['ssao-ratio'], blurRatio: values['ssao-blur-ratio']};
  const pipeline = new SSAO2RenderingPipeline('ssao', scene, ratio, [camera], is_forced);
  Object.assign(pipeline, settings_of(values, 'ssao-', [
    'radius', 'totalStrength', 'base', 'samples', 'epsilon', 'maxZ', 'minZAspect', 'bypassBlur', 'expensiveBlur',
    'bilateralSamples', 'bilateralSoften', 'bilateralTolerance']));
  return {
    dispose() {
      pipeline.dispose(true);
      if (!is_forced) scene.disablePrePassRenderer();
    },
  };
}
