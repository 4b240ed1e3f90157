// L11, N1: the edges on which a fin stands, and how strongly it shows. The same formula as fins.rs, which tests count by.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> skin: array<vec4u>;
@group(0) @binding(2) var<storage, read> fur: array<vec4u>;
@group(0) @binding(3) var<storage, read> looks: array<vec4u>;
@group(0) @binding(4) var<storage, read> edges: array<vec4u>;  // three for each edge

// Lengyel et al. 2001, section 2.3.
fn faded(area: vec3f, offset: vec3f, normal_a: vec3f, normal_b: vec3f, curvature: f32) -> f32 {
    let toward_eye = frame.toward_eye.xyz;
    let faces = max(dot(normal_a, toward_eye), dot(normal_b, toward_eye)) > 0.0;
    let between = normal_a + normal_b;
    let over_horizon = dot(between, toward_eye) / max(length(between), 1e-20);
    if !(faces || over_horizon > -curvature * length(offset)) {
        return 0.0;
    }
    return max(0.0, 2.0 * abs(dot(normalize(area), toward_eye)) - 1.0);
}

// NVIDIA's sample: a silhouette's edge, or nearly one. A boundary has no second face, whose normal is zero: it is always one.
fn silhouette(middle: vec3f, normal_a: vec3f, normal_b: vec3f) -> f32 {
    let toward_eye = normalize(frame.eye.xyz - middle);
    let cosines = vec2f(dot(toward_eye, normal_a), dot(toward_eye, normal_b));
    let near = min(abs(cosines.x), abs(cosines.y)) < frame.fins.y;
    return select(0.0, 1.0, cosines.x * cosines.y <= 0.0 || near);
}

fn fin_opacity(edge: u32) -> f32 {
    let ends = edges[3u * edge];
    let first = edges[3u * edge + 1u];
    let second = edges[3u * edge + 2u];
    let a = vertex_at(ends.x);
    let b = vertex_at(ends.y);
    let offset = 0.5 * (a.offset + b.offset);
    let along = b.position - a.position;
    let area = cross(along, offset);
    // A quad without area has no normal.
    if !(dot(area, area) > 1e-10 * dot(along, along) * dot(offset, offset)) {
        return 0.0;
    }
    let normal_a = bitcast<vec3f>(first.xyz);
    let normal_b = bitcast<vec3f>(second.xyz);
    switch u32(frame.fins.x) {
        case 0u: { return faded(area, offset, normal_a, normal_b, bitcast<f32>(first.w)); }
        case 1u: { return silhouette(0.5 * (a.position + b.position), normal_a, normal_b); }
        default: { return 1.0; }
    }
}

fn kept(edge: u32) -> u32 {
    return bitcast<u32>(fin_opacity(edge));
}
