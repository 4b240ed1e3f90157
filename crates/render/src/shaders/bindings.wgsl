// What the drawing passes are given. Mirrors pipelines.rs.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> shells: array<Shell, 256>;
#if INSTANCED
@group(0) @binding(2) var<storage, read> places: array<Place>;
#else
@group(0) @binding(2) var<storage, read> visible_fins: array<vec2u>;  // edge, opacity
#endif
@group(0) @binding(3) var factor_table: texture_2d<f32>;
@group(0) @binding(4) var table_sampler: sampler;
@group(0) @binding(5) var tile_sampler: sampler;
@group(0) @binding(6) var fin_sampler: sampler;
@group(0) @binding(7) var shell_images: texture_2d_array<f32>;
@group(0) @binding(8) var hair_directions: texture_2d_array<f32>;
@group(0) @binding(9) var shadow_skin: texture_depth_2d;
@group(0) @binding(10) var shadow_fronts: texture_2d<f32>;
@group(0) @binding(11) var shadow_slices: texture_2d<f32>;
@group(0) @binding(12) var shadow_sampler: sampler_comparison;
@group(0) @binding(13) var skin_image: texture_2d<f32>;  // of the finest level, which has no hair on it

@group(1) @binding(0) var<storage, read> skin: array<vec4u>;   // position, normal
@group(1) @binding(1) var<storage, read> fur: array<vec4u>;    // offset, hair direction
@group(1) @binding(2) var<storage, read> looks: array<vec4u>;  // colour, end, bend, mix as half floats
@group(1) @binding(3) var<storage, read> edges: array<vec4u>;  // three for each edge
@group(1) @binding(4) var fin_texture: texture_2d_array<f32>;
