// A vertical ramp behind everything, with alpha 0: what covers it makes the picture's coverage.

struct Ramp {
    top: vec4f,
    bottom: vec4f,
};

@group(0) @binding(0) var<uniform> ramp: Ramp;

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) height: f32,
};

@vertex
fn background_vertex(@builtin(vertex_index) corner: u32) -> Corner {
    let at = vec2f(f32((corner << 1u) & 2u), f32(corner & 2u)) * 2.0 - 1.0;
    return Corner(vec4f(at, 0.0, 1.0), 0.5 + 0.5 * at.y);
}

@fragment
fn background_fragment(in: Corner) -> @location(0) vec4f {
    // Half a step of eight bits either way, by a hash of the pixel (Jimenez 2014), or a ramp this slow shows its bands. Steps are even in the
    // encoded value, which a power follows closely enough.
    let noise = fract(52.9829189 * fract(dot(floor(in.position.xy), vec2f(0.06711056, 0.00583715)))) - 0.5;
    let encoded = pow(mix(ramp.bottom.rgb, ramp.top.rgb, in.height), vec3f(1.0 / 2.2)) + noise * (0.9 / 255.0);
    return vec4f(pow(max(encoded, vec3f(0.0)), vec3f(2.2)), 0.0);
}
