// L11: a quad on each edge near the silhouette, faded by how squarely it faces the viewer. The same formula as fins.rs, which counts them.

struct FinVertex {
    @builtin(position) position: vec4f,
    // Centroid: a fin a fraction of a pixel high would else be lit by what lies far outside of it.
    @location(0) @interpolate(perspective, centroid) fin: vec4f,      // along the texture, height, growth, opacity
    @location(1) @interpolate(perspective, centroid) ambient: vec3f,  // the light without what dies away with depth, which is not linear along the hair
    @location(2) @interpolate(perspective, centroid) direct: vec4f,   // likewise, and the optical depth of the whole length towards the light
};

fn fin_opacity(a: vec3f, b: vec3f, offset: vec3f, normal_a: vec3f, normal_b: vec3f, curvature: f32) -> f32 {
    let along = b - a;
    let area = cross(along, offset);
    let size = dot(along, along) * dot(offset, offset);
    // A quad without area has no normal.
    if !(dot(area, area) > 1e-10 * size) {
        return 0.0;
    }
    let toward_eye = frame.toward_eye.xyz;
    let faces = max(dot(normal_a, toward_eye), dot(normal_b, toward_eye)) > 0.0;
    let between = normal_a + normal_b;
    let over_horizon = dot(between, toward_eye) / max(length(between), 1e-20);
    if !(faces || over_horizon > -curvature * length(offset)) {
        return 0.0;
    }
    return max(0.0, 2.0 * abs(dot(normalize(area), toward_eye)) - 1.0);
}

@vertex
fn fin_vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) edge: u32) -> FinVertex {
    let ends = edges[3u * edge];
    let first = edges[3u * edge + 1u];
    let second = edges[3u * edge + 2u];
    let a = vertex_at(ends.x);
    let b = vertex_at(ends.y);
    let opacity = fin_opacity(
        a.position, b.position, 0.5 * (a.offset + b.offset), bitcast<vec3f>(first.xyz), bitcast<vec3f>(second.xyz), bitcast<f32>(first.w));
    if opacity <= 0.0 {
        // All four corners in one place: nothing is drawn.
        return FinVertex(vec4f(0.0, 0.0, 0.0, 1.0), vec4f(0.0), vec3f(0.0), vec4f(0.0));
    }
    var v = a;
    if (corner & 1u) == 1u {
        v = b;
    }
    let height = f32(corner >> 1u);
    let along = bitcast<f32>(select(ends.z, ends.w, (corner & 1u) == 1u));
    let place = v.position + v.offset * height;
    let half = half_vector(normalize(frame.eye.xyz - place));
    let factor = factors(dot(v.direction, frame.light.xyz), dot(v.direction, half.xyz)) * vec2f(1.0, half.w);
    let n_dot_l = dot(v.normal, frame.light.xyz);
    return FinVertex(
        frame.clip_from_coat * vec4f(place, 1.0), vec4f(along, height, growth_of(v.offset), opacity),
        v.colour * frame.ambient.xyz * irradiance(v.normal),
        vec4f(v.colour * reflected(factor) * frame.light_colour.xyz * facing(n_dot_l), slanted_density(n_dot_l)));
}

@fragment
fn fin_fragment(in: FinVertex) -> @location(0) vec4f {
    // Row 0 of the texture is the tips.
    let depth = 1.0 - in.fin.y;
    let hair = textureSample(fin_texture, fin_sampler, vec2f(in.fin.x, depth)) * (in.fin.w * clamp(in.fin.z, 0.0, 1.0));
    let light = in.ambient * floored(frame.shadow.w * depth) + in.direct.xyz * floored(in.direct.w * depth);
    return vec4f(hair.rgb * light, hair.a);
}
