// L10: the whole mesh, opaque, writing depth. Under fur it shows the innermost shell at full depth of shadow; where there is none, plain skin.

struct SurfaceVertex {
    @builtin(position) position: vec4f,
    @location(0) tile: vec3f,   // tile coordinates, growth
    @location(1) light: vec3f,  // under the fur, lit at vertices: hardly any of it is seen
    @location(2) skin: vec3f,   // the skin's own colour, lit at pixels
    @location(3) normal: vec3f,
};

@vertex
fn surface_vertex(@location(0) index: u32, @location(1) tile: vec2f) -> SurfaceVertex {
    let v = vertex_at(index);
    // The skin's own colour is the mean of its layer: the last level of detail.
    let mean = textureSampleLevel(shell_images, tile_sampler, vec2f(0.5), shells[0].image, 16.0).rgb;
    return SurfaceVertex(
        frame.clip_from_coat * vec4f(v.position, 1.0), vec3f(tile, growth_of(v.offset)),
        v.colour * hair_light(v.position, v.normal, v.direction, shells[0].light_height), v.colour * mean, v.normal);
}

@fragment
fn surface_fragment(in: SurfaceVertex) -> @location(0) vec4f {
    let under_fur = textureSample(shell_images, tile_sampler, in.tile.xy, shells[0].image).rgb * in.light;
    let bare = in.skin * skin_light(normalize(in.normal));
    return vec4f(mix(bare, under_fur, clamp(in.tile.z, 0.0, 1.0)), 1.0);
}
