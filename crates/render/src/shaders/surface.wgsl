// L10: the whole mesh, opaque, writing depth. Under fur it shows the innermost layer at full depth of shadow; where there is none, plain skin.

struct SurfaceVertex {
    @builtin(position) position: vec4f,
    @location(0) place: vec3f,
    @location(1) normal: vec3f,
    @location(2) direction: vec3f,
    @location(3) colour: vec3f,
    @location(4) tile: vec3f,  // tile coordinates, growth
};

@vertex
fn surface_vertex(@location(0) index: u32, @location(1) tile: vec2f) -> SurfaceVertex {
    let v = vertex_at(index);
    return SurfaceVertex(
        frame.clip_from_coat * vec4f(v.position, 1.0), v.position, v.normal, v.direction, v.colour,
        vec3f(tile, growth_of(v.offset)));
}

@fragment
fn surface_fragment(in: SurfaceVertex) -> @location(0) vec4f {
    let growth = clamp(in.tile.z, 0.0, 1.0);
    let normal = normalize(in.normal);
    let under_fur = textureSample(shell_layers, tile_sampler, in.tile.xy, 0).rgb
        * hair_light(in.place, normal, normalize(in.direction), 0.0);
    // The skin's own colour is the mean of its layer: the last level of detail.
    let bare = textureSampleLevel(shell_layers, tile_sampler, in.tile.xy, 0, 16.0).rgb * skin_light(normal);
    return vec4f(in.colour * mix(bare, under_fur, growth), 1.0);
}
