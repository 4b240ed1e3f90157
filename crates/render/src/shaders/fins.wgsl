// L11: a strip of quads on each edge that was picked (select_fins.wgsl), faded by how squarely it faces the viewer.

struct FinVertex {
    @builtin(position) position: vec4f,
    // Centroid: a fin a fraction of a pixel high would else be lit by what lies far outside of it.
    @location(0) @interpolate(perspective, centroid) fin: vec4f,      // along the texture, height, growth, opacity
    @location(1) @interpolate(perspective, centroid) ambient: vec3f,  // the light without what dies away with depth, which is not linear along the hair
    @location(2) @interpolate(perspective, centroid) direct: vec4f,   // the first light, likewise, and the optical depth of the whole length towards it
    @location(5) @interpolate(perspective, centroid) others: vec3f,   // the other lights, shadowed
#if SHADOW_MAP
    @location(4) @interpolate(perspective, centroid) in_light: vec3f,
#endif
#if CUT
    @location(3) @interpolate(perspective, centroid) end: f32,
#endif
#if MIXED
    @location(6) @interpolate(perspective, centroid) mix: f32,
#endif
};

@vertex
fn fin_vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) fin: u32) -> FinVertex {
    let picked = visible_fins[fin];
    let ends = edges[3u * picked.x];
    let right = (corner & 1u) == 1u;
    let v = vertex_at(select(ends.x, ends.y, right));
    let height = f32(corner >> 1u) / frame.fins.z;
    let along = bitcast<f32>(select(ends.z, ends.w, right));
    let place = v.position + curve(v, height);
    let toward_eye = normalize(frame.eye.xyz - place);
    let direction = direction_at(v, height);
    // The first light's depth is taken pixel by pixel; what the others lose by it, at half the height.
    let n_dot_l = dot(v.normal, frame.lights[0].direction.xyz);
    let key = hair_response(0u, direction, toward_eye) * frame.lights[0].colour.xyz * facing(n_dot_l);
    var out: FinVertex;
    out.position = frame.clip_from_coat * vec4f(place, 1.0);
    out.fin = vec4f(along, height, growth_of(v.offset), bitcast<f32>(picked.y) * frame.fins.w);
    out.ambient = v.colour * frame.ambient.xyz * irradiance(v.normal);
    out.direct = vec4f(v.colour * key, slanted_density(n_dot_l));
    out.others = v.colour * lights_from(1u, direction, v.normal, toward_eye, 0.5);
#if SHADOW_MAP
    out.in_light = place_in_light(place, v.normal, length(v.offset) * (1.0 - height));
#endif
#if CUT
    out.end = v.end;
#endif
#if MIXED
    out.mix = v.mix;
#endif
    return out;
}

@fragment
fn fin_fragment(in: FinVertex) -> @location(0) vec4f {
    // Row 0 of the texture is the tips.
    let depth = 1.0 - in.fin.y;
#if MIXED
    set_mixture(in.mix);
    // A drawn fin may be one for all.
    let last = textureNumLayers(fin_texture) - 1u;
    let first = textureSample(fin_texture, fin_sampler, vec2f(in.fin.x, depth), min(mixtures_before, last));
    let next = textureSample(fin_texture, fin_sampler, vec2f(in.fin.x, depth), min(mixtures_before + 1u, last));
    var hair = mix(first, next, to_next_mixture);
#else
    var hair = textureSample(fin_texture, fin_sampler, vec2f(in.fin.x, depth), 0);
#endif
    hair *= in.fin.w * clamp(in.fin.z, 0.0, 1.0);
#if CUT
    hair *= clamp(cut_of(in.end, in.fin.y), 0.0, 1.0);
#endif
    var direct = in.direct.xyz * floored(in.direct.w * depth);
#if SHADOW_MAP
    direct *= shadow_at(in.in_light);
#endif
    let light = in.ambient * floored(frame.shadow.w * depth) + direct + in.others;
    return vec4f(hair.rgb * light, hair.a);
}
