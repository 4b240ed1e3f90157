// L10: the whole mesh, opaque, writing depth. Under fur it shows the innermost shell at full depth of shadow; where there is none, plain skin.

struct SurfaceVertex {
    @builtin(position) position: vec4f,
    @location(0) tile: vec3f,   // tile coordinates, growth
    @location(1) light: vec3f,  // under the fur, lit at vertices: hardly any of it is seen
#if !GROWN
    @location(2) skin: vec3f,   // the skin's own colour, lit at pixels
    @location(3) normal: vec3f,
#endif
#if SHADOW_MAP
    @location(4) direct: vec3f,  // what of `light` is the first light's
    @location(5) in_light: vec3f,
#endif
#if MIXED
    @location(6) mix: f32,
#endif
};

#if INSTANCED
@vertex
fn surface_vertex(@location(0) index: u32, @location(1) tile: vec2f, @location(5) instance: u32) -> SurfaceVertex {
    place_number = instance >> 8u;
#else
@vertex
fn surface_vertex(@location(0) index: u32, @location(1) tile: vec2f) -> SurfaceVertex {
#endif
    let v = vertex_at(index);
    let depth = 1.0 - shells[0].light_height;
    let toward_eye = normalize(frame.eye.xyz - v.position);
    var out: SurfaceVertex;
    out.position = frame.clip_from_coat * vec4f(v.position, 1.0);
    out.tile = vec3f(tile, growth_of(v.offset));
#if MIXED
    out.mix = v.mix;
#endif
#if !GROWN
    // The skin's own colour is the mean of its layer: the last mip.
    out.skin = v.colour * textureSampleLevel(skin_image, tile_sampler, vec2f(0.5), 16.0).rgb;
    out.normal = v.normal;
#endif
#if SHADOW_MAP
    out.light = v.colour * (ambient_light(v.normal, depth) + lights_from(1u, v.direction, v.normal, toward_eye, depth));
    out.direct = v.colour * hair_response(0u, v.direction, toward_eye) * direct_light(0u, v.normal, depth);
    out.in_light = place_in_light(v.position, v.normal, length(v.offset));
#else
    out.light = v.colour * (ambient_light(v.normal, depth) + lights_from(0u, v.direction, v.normal, toward_eye, depth));
#endif
    return out;
}

// The skin, with the hair on it that coarse levels of detail have there.
fn skin_at(tile: vec2f) -> vec3f {
    var seen = shell_texel(tile, shells[0].images & 0xffffu, 0.0).rgb;
#if LEVELS
    seen = mix(seen, shell_texel(tile, shells[0].images >> 16u, 0.0).rgb, later());
#endif
    return seen;
}

@fragment
fn surface_fragment(in: SurfaceVertex) -> @location(0) vec4f {
#if MIXED
    set_mixture(in.mix);
#endif
#if SHADOW_MAP
    let shadow = shadow_at(in.in_light);
    let light = in.light + in.direct * shadow;
#else
    let shadow = 1.0;
    let light = in.light;
#endif
    let under_fur = skin_at(in.tile.xy) * light;
#if GROWN
    return vec4f(under_fur, 1.0);
#else
    let bare = in.skin * skin_light(normalize(in.normal), shadow);
    return vec4f(mix(bare, under_fur, clamp(in.tile.z, 0.0, 1.0)), 1.0);
#endif
}
