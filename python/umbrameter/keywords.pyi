"""Parameters as keyword arguments. Written by scripts/docs --references; do not edit."""
from typing import Literal, TypedDict


class Keywords(TypedDict, total=False):
    """The program's parameters."""

    scene_unit: str
    """unit of lengths: mm, cm, m, km, inch, foot, or its length in m; text. Default: m."""
    scene_blend: Literal['opaque', 'leave-out', 'mask']
    """alpha-blended and transmissive surfaces; mask: holes where alpha is below 0.5; opaque, leave-out or mask. Default: opaque."""
    scene_ground: bool
    """add a floor below the scene, 5 times its diagonal wide; true or false. Default: False."""
    view_size: str | tuple[int, int]
    """image size, width x height [px]; WIDTHxHEIGHT, each an integer from 1 to 16384. Default: 1280x720."""
    view_scene: str
    """scene in the file, by name or index; empty: the file's default; text."""
    view_camera: str
    """camera, by name or index; empty: the first; text."""
    view_light: str
    """light, by name or index; empty: all, or the first in a sweep; text."""
    view_surfels: Literal['raster', 'traced']
    """renderer of the G-buffer that reference and technique share; raster or traced. Default: raster."""
    light_radius: float
    """radius of point and spot lights; 0: none, -1: the scene's [m]; a number from -1 to 1e+12. Default: -1.0."""
    light_width: float
    """width of a rectangular light, along its x axis; 0: none, -1: the scene's [m]; a number from -1 to 1e+12. Default: -1.0."""
    light_height: float
    """height of a rectangular light, along its y axis; 0: none, -1: the scene's [m]; a number from -1 to 1e+12. Default: -1.0."""
    light_angle: float
    """angular diameter of suns; 0: none, -1: the scene's [degrees]; a number from -1 to 179. Default: -1.0."""
    light_shape: Literal['usual', 'sphere', 'disk']
    """shape of a light with a radius; usual: sphere for point lights, disk for spot lights; usual, sphere or disk. Default: usual."""
    shadow_resolution: int
    """side of the shadow map or cube face [texels]; an integer from 1 to 16384. Default: 1024."""
    shadow_cascades: int
    """views of a directional light's map, nearer ones finer; an integer from 1 to 8. Default: 1."""
    shadow_split_lambda: float
    """splits of the cascades: 1 logarithmic, 0 uniform; a number from 0 to 1. Default: 0.5."""
    shadow_splits: str
    """ends of the first cascades as shares of the range, '0.1,0.2,0.5'; empty: by lambda; text."""
    shadow_cascade_bias: str
    """factors of the constant bias in the cascades, '1,2,4', or own-range: a bias in 'depth' is a share of each cascade's own depth range; text."""
    shadow_split_range: Literal['seen', 'camera']
    """depths that the cascades divide: seen: those seen, camera: near plane to max-distance; seen or camera. Default: seen."""
    shadow_max_distance: float
    """with split-range camera: farthest depth that the cascades divide [m]; a number from 1e-06 to 1e+12. Default: 100.0."""
    shadow_fit: Literal['scene', 'view', 'bounds']
    """area of a directional light's map; with cascades, of the last one; scene, view or bounds. Default: scene."""
    shadow_fit_x: float
    """with fit bounds: centre of the area, in the world [m]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_fit_y: float
    """with fit bounds: centre of the area, in the world [m]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_fit_z: float
    """with fit bounds: centre of the area, in the world [m]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_fit_size: float
    """with fit bounds: side of the area, perpendicular to the light [m]; a number from 1e-06 to 1e+12. Default: 10.0."""
    shadow_fit_depth: float
    """with fit bounds: depth range of the area about its centre; 0: the scene's [m]; a number from 0 to 1e+12. Default: 0.0."""
    shadow_cascade_fit: Literal['tight', 'stable', 'boxes']
    """area of a cascade; tight: around what is seen, stable: around the camera's frustum, moved in whole texels, boxes: around the part of it that lies in the bounding boxes of objects; tight, stable or boxes. Default: tight."""
    shadow_cascade_selection: Literal['map', 'depth']
    """cascade of a receiver: the first that contains it, or by its view depth; map or depth. Default: map."""
    shadow_cascade_blend: float
    """share of a cascade's extent over which it is blended into the next, by dithering; a number from 0 to 1. Default: 0.0."""
    shadow_fade: float
    """last share of shadow.max-distance over which shadows fade; a number from 0 to 1. Default: 0.0."""
    shadow_warp: Literal['none', 'lispsm']
    """warp of a single map fitted to the view: none, or light-space perspective; none or lispsm. Default: none."""
    shadow_warp_near: float
    """start of the view depths that the warp serves best [m]; a number from 0 to 1e+12. Default: 1.0."""
    shadow_warp_far: float
    """end of the view depths that the warp serves best [m]; a number from 1e-06 to 1e+12. Default: 100.0."""
    shadow_pancaking: bool
    """start a directional light's depth range at the receivers, clamp casters before it; true or false. Default: False."""
    shadow_near_offset: float
    """pancaking: from the start of the depth range to the nearest receiver [m]; a number from 0 to 1e+12. Default: 1.0."""
    shadow_depth_format: Literal['32f', '16f', '16f-down', '24', '16']
    """format of the shadow map: 32- or 16-bit float (16f-down: rounded down), 24- or 16-bit fixed point; 32f, 16f, 16f-down, 24 or 16. Default: 32f."""
    shadow_depth_encoding: Literal['linear', 'perspective', 'reversed']
    """depth that the map stores: linear, of a projection matrix, or that reversed; linear, perspective or reversed. Default: linear."""
    shadow_depth_near: float
    """near plane of spot and point lights with a perspective or reversed encoding [m]; a number from 1e-06 to 1e+12. Default: 0.1."""
    shadow_depth_far: float
    """far plane of perspective encodings; 0: the farthest surface [m]; a number from 0 to 1e+12. Default: 0.0."""
    shadow_receiver_precision: Literal['full', 'single']
    """precision of receivers' depths in a spot light's perspective encoding; single: as in engines; full or single. Default: full."""
    shadow_depth_comparison: Literal['less-equal', 'less']
    """with receivers in single precision: a receiver is lit whose depth has this relation to the stored one; less-equal or less. Default: less-equal."""
    shadow_faces: Literal['all', 'front', 'back']
    """faces that cast, seen from the light; all, front or back. Default: all."""
    shadow_surface: Literal['nearest', 'midpoint', 'second', 'dual']
    """surface whose depth the map holds, of the first two that the light meets; nearest, midpoint, second or dual. Default: nearest."""
    shadow_dual_offset: float
    """dual: how far behind the nearest surface the stored depth lies at most [m]; a number from 0 to 1e+12. Default: 0.02."""
    shadow_polygon_offset_factor: float
    """hardware polygon offset: this number times the depth's slope per texel; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_polygon_offset_units: float
    """hardware polygon offset: this number times the unit of the map's format, which is measured [units]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_caster_offset: float
    """moves the vertices of casters against their normals, times the profile [texels]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_caster_offset_metres: float
    """the same in metres; added to that in texels [m]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_caster_offset_profile: Literal['sine', 'constant', 'one-minus-cosine', 'eevee']
    """factor of the casters' offset: sin θ, 1, 1 − cos θ or sin θ + 0.168; sine, constant, one-minus-cosine or eevee. Default: sine."""
    shadow_point_map: Literal['cube', 'paraboloid']
    """map of a point light: six cube faces or two paraboloids; cube or paraboloid. Default: cube."""
    shadow_cube_passes: bool
    """draw a cube map in six passes instead of one; the map is the same; true or false. Default: False."""
    shadow_constant_bias: float | str
    """constant bias, along the light's axis or ray [m]; a length from -1e+12 to 1e+12 in m (2cm, 20mm), texels (1.5texels), the map's depth from 0 to 1 (0.0005depth). Default: 1.5texels."""
    shadow_slope_bias: float
    """slope-scaled bias, times tan θ [texels]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_normal_offset: float
    """normal offset, times its profile (sin θ) [texels]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_normal_offset_metres: float
    """normal offset, times its profile; added to that in texels [m]; a number from -1e+12 to 1e+12. Default: 0.0."""
    shadow_normal_offset_profile: Literal['sine', 'constant', 'one-minus-cosine', 'eevee']
    """factor of the normal offset: sin θ, 1, 1 − cos θ or sin θ + 0.168; sine, constant, one-minus-cosine or eevee. Default: sine."""
    shadow_normal_offset_direction: Literal['normal', 'across']
    """normal offset along the normal, or only its part across the light; normal or across. Default: normal."""
    shadow_normal_offset_facing: Literal['viewer', 'front']
    """normal of back faces: turned to the viewer, or that of the front; viewer or front. Default: viewer."""
    shadow_normal_offset_texel: Literal['receiver', 'middle']
    """texel size in the normal offset: at the receiver, or in the middle of a warped map; receiver or middle. Default: receiver."""
    shadow_receiver_plane: bool
    """compare each tap with the depth of the receiver's plane at the tap; true or false. Default: False."""
    shadow_cone_bias: float
    """bias per distance of a tap's texel centre from the receiver; a number from 0 to 1e+12. Default: 0.0."""
    shadow_technique: Literal['pcf', 'esm', 'vsm', 'evsm2', 'evsm4', 'msm', 'csm', 'pcss', 'dpcf', 'screen-space']
    """technique (csm: convolution, dpcf: contact-hardening); pcf, esm, vsm, evsm2, evsm4, msm, csm, pcss, dpcf or screen-space. Default: pcf."""
    shadow_filter: Literal['nearest', 'bilinear', 'box', 'tent', 'gaussian', 'poisson', 'vogel', 'optimized', 'area-tent', 'pcf']
    """PCF kernel; nearest, bilinear, box, tent, gaussian, poisson, vogel, optimized or area-tent; pcf is accepted for box. Default: nearest."""
    shadow_filter_size: int
    """side of the PCF kernel, except disks [texels]; an integer from 1 to 29. Default: 3."""
    shadow_filter_taps: Literal['nearest', 'linear']
    """taps of a box, tent or Gaussian kernel; linear: bilinear 2×2; nearest or linear. Default: nearest."""
    shadow_filter_samples: int
    """taps of the Poisson or Vogel disk; an integer from 1 to 64. Default: 16."""
    shadow_filter_radius: float
    """radius of the Poisson or Vogel disk [texels]; a number from 0 to 64. Default: 2.0."""
    shadow_filter_rotation: Literal['random', 'fixed', 'gradient']
    """rotation of the disk: random per pixel, fixed, or interleaved gradient noise; random, fixed or gradient. Default: random."""
    shadow_pcss_blockers: int
    """PCSS: taps of the blocker search; an integer from 1 to 64. Default: 32."""
    shadow_pcss_light_scale: float
    """PCSS and DPCF: assumed size of the light over its size in the scene; a number from 0 to 1e+12. Default: 1.0."""
    shadow_pcss_max_radius: float
    """PCSS and DPCF: largest radius of search and filter [texels]; a number from 0 to 512. Default: 64.0."""
    shadow_pcss_min_radius: float
    """PCSS: smallest radius of the filter [texels]; a number from 0 to 64. Default: 0.0."""
    shadow_pcss_search_cone: bool
    """PCSS: average only blockers between the receiver and some point of the light; true or false. Default: True."""
    shadow_esm_exponent: float
    """ESM: exponent over the map's depth range; a number from 1 to 80. Default: 40.0."""
    shadow_esm_blur: int
    """ESM: side of the blur of the map [texels]; an odd integer from 1 to 63. Default: 5."""
    shadow_blur_kernel: Literal['box', 'gaussian']
    """filtered maps: kernel of the blur of the map; box or gaussian. Default: box."""
    shadow_moment_blur: int
    """filtered maps except ESM: side of the blur of the map [texels]; an odd integer from 1 to 63. Default: 5."""
    shadow_moment_format: Literal['32f', '16f', 'unorm16']
    """filtered maps except ESM: format; unorm16 is not for EVSM; 32f, 16f or unorm16. Default: 32f."""
    shadow_evsm_positive_exponent: float
    """EVSM: exponent c of exp(c·t), t from −1 to 1 over the map's depth range; a number from 0.1 to 42. Default: 40.0."""
    shadow_evsm_negative_exponent: float
    """EVSM4: exponent c of the second warp, −exp(−c·t); a number from 0.1 to 42. Default: 5.0."""
    shadow_csm_terms: int
    """CSM: terms of the Fourier series, two to a layer; an integer from 1 to 16. Default: 16."""
    shadow_moment_samples: int
    """filtered maps: depths per texel whose stored values are averaged: 1, 4, 9 or 16; an integer from 1 to 16. Default: 1."""
    shadow_moment_mipmaps: bool
    """filtered maps: trilinear look-up by the pixel's footprint in the map; true or false. Default: False."""
    shadow_min_variance: float
    """VSM and EVSM: least variance of the depth, as a share of the square of the map's depth range; a number from 0 to 0.01. Default: 1e-06."""
    shadow_bleeding_reduction: float
    """VSM, EVSM and MSM: visibility up to which all is dark (GPU Gems 3, chapter 8); a number from 0 to 0.99. Default: 0.0."""
    shadow_msm_moment_bias: float
    """MSM: how far each moment is blended towards ½, against rounding; about 6e-5 for unorm16; a number from 0 to 0.1. Default: 1e-05."""
    shadow_msm_bound: Literal['hamburger', 'hausdorff']
    """MSM: hausdorff also uses that all depths lie within the map's range; hamburger or hausdorff. Default: hamburger."""
    shadow_csm_ringing_reduction: float
    """CSM: a in the weight exp(−a·(k/M)²) of the k-th of M terms; a number from 0 to 10. Default: 1.0."""
    shadow_csm_contrast: float
    """CSM: factor of the visibility that the series gives, which is ½ at the occluder's depth; a number from 1 to 10. Default: 2.0."""
    shadow_contact_shadows: bool
    """darken the technique's result by screen-space shadows; true or false. Default: False."""
    shadow_screen_length: float
    """screen-space shadows: length of the ray [m]; a number from 0 to 1e+06. Default: 0.3."""
    shadow_screen_steps: int
    """screen-space shadows: samples along the ray; an integer from 1 to 1024. Default: 8."""
    shadow_screen_thickness: float
    """screen-space shadows: assumed thickness of every surface [m]; a number from 0 to 1e+06. Default: 0.1."""
    shadow_screen_bias: float
    """screen-space shadows: a surface blocks if it lies in front of the ray by more than this share of the depth; a number from 0 to 1. Default: 0.002."""
    shadow_screen_jitter: bool
    """screen-space shadows: shift the samples by interleaved gradient noise; true or false. Default: True."""
    shadow_screen_plane: bool
    """screen-space shadows: ignore what lies behind the receiver's tangent plane; true or false. Default: True."""
    ao_samples: int
    """samples per pixel; not of HBAO, GTAO and the bitmask; an integer from 1 to 1024. Default: 64."""
    ao_radius: float | str
    """radius of the sampled hemisphere [m]; a length from 1e-06 to 1e+12 in m (2cm, 20mm), % of the scene's diagonal (2%). Default: 2%."""
    ao_bias: float | str
    """min depth difference between occluder and sample [m]; a length from -1e+12 to 1e+12 in m (2cm, 20mm), % of the scene's diagonal (2%). Default: 0.1%."""
    ao_noise_size: int
    """side of the tile of random rotations [px]; an integer from 1 to 64. Default: 4."""
    ao_normals: Literal['exact', 'rgb8', 'depth']
    """normals that technique and blur read: exact, 8 bits a component, or from depth; exact, rgb8 or depth. Default: exact."""
    ao_technique: Literal['ssao', 'gtao', 'hbao', 'alchemy', 'crytek', 'bitmask', 'ray-marched']
    """AO technique; ssao, gtao, hbao, alchemy, crytek, bitmask or ray-marched. Default: ssao."""
    ao_range_check: bool
    """fade out surfaces whose depth differs from the pixel's by more than the radius; true or false. Default: True."""
    ao_kernel: Literal['learnopengl', 'progressive']
    """points of hemisphere SSAO: random as in Learn OpenGL, or a progressive sequence: more samples keep the earlier points; learnopengl or progressive. Default: learnopengl."""
    ao_slices: int
    """GTAO and bitmask: slices per pixel; an integer from 1 to 256. Default: 3."""
    ao_steps: int
    """GTAO and bitmask: samples on each side of a slice; an integer from 1 to 1024. Default: 3."""
    ao_slice_spacing: Literal['image', 'angle']
    """slices are even in the image, or in angle about the direction to the viewer; image or angle. Default: image."""
    ao_gtao_radius_multiplier: float
    """GTAO: radius at which the falloff ends [ao.radius]; a number from 0.001 to 1e+12. Default: 1.457."""
    ao_gtao_falloff: float
    """GTAO: last part of the radius, over which occluders fade out; a number from 0 to 1. Default: 0.615."""
    ao_gtao_distribution: float
    """GTAO: exponent of the steps' distances; a number from 0.1 to 10. Default: 2.0."""
    ao_gtao_thin_compensation: float
    """GTAO: the falloff multiplies depth differences by 1 + this: thin occluders fade sooner; a number from 0 to 100. Default: 0.0."""
    ao_gtao_power: float
    """GTAO: exponent of the result; a number from 0.1 to 10. Default: 2.2."""
    ao_hbao_directions: int
    """HBAO: directions per pixel; an integer from 1 to 256. Default: 6."""
    ao_hbao_steps: int
    """HBAO: samples per direction; an integer from 1 to 1024. Default: 6."""
    ao_hbao_tangent_bias: float
    """HBAO: angle above the tangent plane from which surfaces occlude [degrees]; a number from 0 to 90. Default: 5.0."""
    ao_hbao_intensity: float
    """HBAO: factor on the occlusion; a number from 0 to 1e+12. Default: 1.0."""
    ao_hbao_jitter: bool
    """HBAO: shift the steps by an offset that differs from pixel to pixel; true or false. Default: True."""
    ao_alchemy_estimator: Literal['alchemy', 'sao']
    """Alchemy AO: estimator of 2011, or that of Scalable Ambient Obscurance, 2012; alchemy or sao. Default: sao."""
    ao_alchemy_turns: int
    """Alchemy AO: turns of the spiral of samples; an integer from 1 to 1024. Default: 7."""
    ao_alchemy_bias: float
    """Alchemy AO: height above the tangent plane that does not occlude [ao.radius]; a number from -1e+12 to 1e+12. Default: 0.01."""
    ao_alchemy_intensity: float
    """Alchemy AO: factor on the occlusion; a number from 0 to 1e+12. Default: 1.0."""
    ao_alchemy_mip_chain: bool
    """Alchemy AO: far samples read a depth pyramid, as in Scalable Ambient Obscurance; true or false. Default: False."""
    ao_alchemy_mip_offset: int
    """Alchemy AO: a sample p pixels away reads level floor(log2(p)) less this; an integer from 0 to 16. Default: 3."""
    ao_alchemy_mip_levels: int
    """Alchemy AO: levels of the depth pyramid beyond the depth buffer; an integer from 1 to 14. Default: 5."""
    ao_bitmask_thickness: float
    """bitmask: thickness of every surface [ao.radius]; a number from 0 to 1e+12. Default: 0.25."""
    ao_bitmask_distribution: float
    """bitmask: exponent of the steps' distances; a number from 0.1 to 10. Default: 2.0."""
    ao_bitmask_weight: Literal['angle', 'cosine']
    """bitmask: sectors of equal angles, or of equal shares of the cosine's integral; angle or cosine. Default: angle."""
    ao_bitmask_rounding: Literal['up', 'nearest']
    """bitmask: a surface covers every sector it reaches, or those whose centre it covers; up or nearest. Default: up."""
    ao_march_steps: int
    """ray marching: max steps of a ray; fewer if it crosses fewer pixels; an integer, at least 1. Default: 1024."""
    ao_march_thickness: float
    """ray marching: thickness of every surface [ao.radius]; a number from 0 to 1e+12. Default: 1.0."""
    ao_march_bias: float
    """ray marching: height above the tangent plane that does not occlude [ao.radius]; a number from -1e+12 to 1e+12. Default: 0.001."""
    ao_march_weight: Literal['cosine', 'uniform']
    """ray marching: distribution of the rays in the hemisphere; cosine or uniform. Default: cosine."""
    ao_blur: Literal['own', 'none', 'box', 'gaussian', 'bilateral', 'xegtao']
    """blur; own: that of the technique's publication; own, none, box, gaussian, bilateral or xegtao. Default: own."""
    ao_blur_size: int
    """width of the blur; that of xegtao is always 3 [px]; an integer from 1 to 32. Default: 4."""
    ao_blur_passes: int
    """passes of the blur; an integer from 1 to 16. Default: 1."""
    ao_blur_plane_distance: float
    """bilateral blur: distance from the tangent plane at which a weight falls to 1/e; 0: it has no effect [ao.radius]; a number from 0 to 1e+12. Default: 0.05."""
    ao_blur_normal_exponent: float
    """bilateral blur: exponent of the cosine between normals; a number from 0 to 1e+12. Default: 8.0."""
    ao_resolution: Literal['full', 'half']
    """resolution of technique and blur; half: every second pixel of both axes; full or half. Default: full."""
    ao_upsampling_plane_distance: float
    """half resolution: distance from the tangent plane at which a weight falls to 1/e; 0: it has no effect [ao.radius]; a number from 0 to 1e+12. Default: 0.05."""
    ao_upsampling_normal_exponent: float
    """half resolution: exponent of the cosine between normals; a number from 0 to 1e+12. Default: 8.0."""
    ao_intensity: float
    """factor on the occlusion, after the blur; a number from 0 to 1e+12. Default: 1.0."""
    ao_power: float
    """exponent of the result, after blur and intensity; a number from 0.01 to 100. Default: 1.0."""
    ao_multi_bounce: bool
    """brighten by the light of further bounces, after the blur and before intensity; true or false. Default: False."""
    ao_multi_bounce_albedo: float
    """multi-bounce: albedo of all surfaces; a number from 0 to 1. Default: 0.5."""
    ao_multi_bounce_albedo_source: Literal['constant', 'surface']
    """multi-bounce: one albedo for all surfaces, or the luminance of each surfel's diffuse albedo; constant or surface. Default: constant."""
    shading_path: Literal['forward', 'deferred']
    """how the image is shaded; forward or deferred. Default: forward."""
    shading_specular: Literal['phong', 'blinn-phong', 'blinn']
    """specular term; phong or blinn-phong; blinn is accepted for blinn-phong. Default: blinn-phong."""
    shading_normalization: Literal['energy', 'none']
    """scale reflection so that it conserves energy, or the classic formula; energy or none. Default: energy."""
    shading_ambient: float
    """ambient light, reflected by every surface and scaled by AO; a number from 0 to 1e+12. Default: 0.1."""
    shading_exposure: float
    """factor on the linear image; a number from 1e-12 to 1e+12. Default: 1.0."""
    shading_attenuation: Literal['inverse-square', 'polynomial']
    """1/d² with the range window of KHR_lights_punctual, or 1/(c + l·d + q·d²); inverse-square or polynomial. Default: inverse-square."""
    shading_constant: float
    """c of the polynomial attenuation; a number from 0 to 1e+12. Default: 1.0."""
    shading_linear: float
    """l of the polynomial attenuation [1/m]; a number from 0 to 1e+12. Default: 0.0."""
    shading_quadratic: float
    """q of the polynomial attenuation [1/m²]; a number from 0 to 1e+12. Default: 1.0."""
    shading_spot_falloff: Literal['smooth', 'linear']
    """smooth as in KHR_lights_punctual, or linear in the angle from axis to edge; smooth or linear. Default: smooth."""
    shading_volume_faces: Literal['front', 'back']
    """faces of a light volume that the deferred path draws; front or back. Default: back."""
    shading_normal_format: Literal['rgb32f', 'rgb16f', 'rg16', 'rgb8']
    """normals of the deferred G-buffer; rg16 is octahedral; rgb32f, rgb16f, rg16 or rgb8. Default: rgb8."""
    shading_depth_format: Literal['depth32f', 'depth24', 'depth16']
    """depth of the deferred G-buffer; depth32f, depth24 or depth16. Default: depth32f."""
    shading_position: Literal['depth', 'stored']
    """positions rebuilt from depth, or stored as 32-bit floats; depth or stored. Default: depth."""
    shading_color_format: Literal['rgba8', 'rgba32f']
    """diffuse and specular colour and shininess of the deferred G-buffer; rgba8 or rgba32f. Default: rgba8."""
    engine_adapter: str
    """engine to measure in place of our techniques: name of an adapter, or a command; text."""
    frame_visibility: str
    """file of the engine's visibility: the share of light that arrives; text."""
    frame_lit: str
    """file of a frame with shadows; needs frame.unshadowed, takes the place of frame.visibility; text."""
    frame_unshadowed: str
    """file of the same frame without shadows; text."""
    frame_ao: str
    """file of the engine's ambient occlusion, 1 where open; text."""
    frame_occluded: str
    """file of a frame with ambient occlusion; needs frame.open, takes the place of frame.ao; text."""
    frame_open: str
    """file of the same frame without ambient occlusion; text."""
    frame_position: str
    """file of world positions at the pixels' centres; text."""
    frame_depth: str
    """file of depths at the pixels' centres, instead of positions; text."""
    frame_depth_kind: Literal['axis', 'ray', 'linear', 'window', 'reversed', 'reversed-infinite']
    """what the depths are; window is that of OpenGL, Direct3D and Vulkan; axis, ray, linear, window, reversed or reversed-infinite. Default: window."""
    frame_rows: Literal['top', 'bottom']
    """the row that comes first in the files; top or bottom. Default: top."""
    frame_axes: str
    """which of the frame's coordinates are our x, y and z: x,z,-y where Z points up; text. Default: x,y,z."""
    frame_unit: float
    """length of one unit of positions, and of depths along the axis or ray [m]; a number from 1e-09 to 1e+09. Default: 1.0."""
    frame_camera: str
    """the frame's camera as a matrix, world from camera: 16 numbers by columns; text."""
    frame_vertical_fov: float
    """vertical field of view of frame.camera [degrees]; a number from 0.01 to 179. Default: 45.0."""
    frame_near: float
    """near plane of the frame's depths; 0: the camera's [m]; a number from 0 to 1e+12. Default: 0.0."""
    frame_far: float
    """far plane of the frame's depths; 0: the camera's [m]; a number from 0 to 1e+12. Default: 0.0."""
    truth_spp: int
    """rays per pixel, for AO, area lights and pixel means [rays]; an integer from 1 to 65536. Default: 256."""
    truth_ao_weight: Literal['cosine', 'uniform']
    """weight of AO directions; cosine or uniform. Default: cosine."""
    truth_ao_distance: float | str
    """max distance of occluders; 0: no limit, auto: ao.radius [m]; a length from 0 to 1e+12 in m (2cm, 20mm), % of the scene's diagonal (2%), or auto. Default: auto."""
    truth_sampler: Literal['owen', 'random']
    """Owen-scrambled Sobol points, or independent random points; owen or random. Default: owen."""
    truth_tolerance: float
    """adaptive sampling: max half width of 95 % intervals; 0: off; a number from 0 to 1. Default: 0.0."""
    truth_min_spp: int
    """min rays per pixel (adaptive sampling) [rays]; an integer from 64 to 1048576. Default: 128."""
    truth_max_spp: int
    """max rays per pixel (adaptive sampling) [rays]; an integer from 64 to 1048576. Default: 16384."""
    truth_ao_falloff: Literal['none', 'linear', 'quadratic', 'ssao', 'sao', 'hbao', 'gtao']
    """falloff of AO occluders with distance: a curve, or that of a technique; none, linear, quadratic, ssao, sao, hbao or gtao. Default: none."""
    truth_ao_normal: Literal['geometric', 'shading']
    """normal that the AO hemisphere is centred on; geometric or shading. Default: geometric."""
    truth_ao_layers: Literal['none', 'bent-normal', 'hit-distance', 'all']
    """further AO images: mean unoccluded direction, mean hit distance; none, bent-normal, hit-distance or all. Default: none."""
    truth_light_sampling: Literal['area', 'solid-angle']
    """visibility of an area light: visible share of its area or of its solid angle; area or solid-angle. Default: area."""
    truth_shadow: Literal['point', 'pixel', 'light']
    """reference of shadows; light: visible share of the light, or 0 or 1 if it has no extent; point: 0 or 1, as if it had none; pixel: mean over the pixel; point, pixel or light. Default: light."""
    run_seed: int
    """seed of all random numbers; an integer from 0 to 2147483647. Default: 1."""
    run_classes: Literal['fast', 'exact']
    """separate acne from false occlusion by triangle planes (fast), or also by rays (exact); fast or exact. Default: exact."""
    run_measure: Literal['auto', 'visibility', 'ao', 'image', 'shadows']
    """what is traced, drawn and measured; auto: shadows and AO, in a sweep depending on the axes; auto, visibility, ao or image; shadows is accepted for visibility. Default: auto."""
    run_shimmer: bool
    """measure shimmer: shadow map and camera move by fractions of a texel or pixel; true or false. Default: False."""
    run_ao_stages: bool
    """split the error of AO by stage, from the method's model to its blur; costs further rays; true or false. Default: False."""
    run_metrics: str
    """image metrics of what is measured, also in sweeps: ldr-flip, ssim, edge-roughness, ... (docs/metrics.md); text."""
    run_write_maps: bool
    """write each shadow map with its projection as an EXR file; true or false. Default: False."""
    run_write_ao_inputs: bool
    """write what the AO technique reads: depth, normals, matrices, kernel and noise, as EXR and JSON; true or false. Default: False."""
    run_overlay: str
    """debug views in a corner of the image and as figures: all, depth, normal, shadow-map:LIGHT, ...; text."""
    run_for: str
    """recommended bias also as settings of engines, such as godot,three:near=1 (three.js with its near plane at 1 m); text."""
