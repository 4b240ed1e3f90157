// What every pass shares: the frame, the skin's vertices, packing. Mirrors uniforms.rs and pack.rs.

struct Frame {
    clip_from_coat: mat4x4f,
    eye: vec4f,           // the eye; w unused
    toward_eye: vec4f,    // the viewer at infinity; w unused
    light: vec4f,         // L; w unused
    light_colour: vec4f,
    irradiance: array<vec4f, 9>,  // coefficients of 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y² of the normal
    ambient: vec4f,       // Ka
    diffuse: vec4f,       // Kd, Pd / 2
    specular: vec4f,      // Ks, Ps / 2
    shadow: vec4f,        // density, minimum, grazing, density seen by the hemisphere
    facing: vec4f,        // strength, dark_below, 1 / (full_above − dark_below)
    fur: vec4f,           // length scale, 1 / (layers − 1), alpha threshold, growth per diameter of length
    screen: vec4f,        // half the width and height in pixels, most levels of blur between layers
    table: vec4f,         // (size − 1) / size, 0.5 / size, u by angle, v by angle
};

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var factor_table: texture_2d<f32>;
@group(0) @binding(2) var table_sampler: sampler;
@group(0) @binding(3) var tile_sampler: sampler;
@group(0) @binding(4) var fin_sampler: sampler;

@group(1) @binding(0) var<storage, read> skin: array<vec4u>;     // position, normal
@group(1) @binding(1) var<storage, read> fur: array<vec4u>;      // offset, hair direction
@group(1) @binding(2) var<storage, read> colours: array<vec2u>;  // half floats
@group(1) @binding(3) var<storage, read> edges: array<vec4u>;    // three for each edge
@group(1) @binding(4) var shell_layers: texture_2d_array<f32>;
@group(1) @binding(5) var fin_texture: texture_2d<f32>;

struct Vertex {
    position: vec3f,
    normal: vec3f,
    offset: vec3f,     // scaled
    direction: vec3f,
    colour: vec3f,
};

// A unit vector from a place on the unfolded octahedron.
fn folded(e: vec2f) -> vec3f {
    let z = 1.0 - abs(e.x) - abs(e.y);
    let fold = max(-z, 0.0);
    return normalize(vec3f(e - select(vec2f(-fold), vec2f(fold), e >= vec2f(0.0)), z));
}

fn unpack_direction(packed: u32) -> vec3f {
    return folded(unpack2x16snorm(packed));
}

// A mean of directions, its length in the top byte.
fn unpack_mean_direction(packed: u32) -> vec3f {
    let e = vec2f(f32(bitcast<i32>(packed << 20u) >> 20u), f32(bitcast<i32>(packed << 8u) >> 20u)) / 2047.0;
    return folded(max(e, vec2f(-1.0))) * (f32(packed >> 24u) / 255.0);
}

fn vertex_at(index: u32) -> Vertex {
    let s = skin[index];
    let f = fur[index];
    let c = colours[index];
    return Vertex(
        bitcast<vec3f>(s.xyz),
        unpack_direction(s.w),
        bitcast<vec3f>(f.xyz) * frame.fur.x,
        unpack_mean_direction(f.w),
        vec3f(unpack2x16float(c.x), unpack2x16float(c.y).x),
    );
}

// How much of its fur a place has, to be clamped to 0 … 1 after interpolation: it comes in over the first thousandth of a diameter of
// length, so that fur without length is no fur and there is no step on the way.
fn growth_of(offset: vec3f) -> f32 {
    return length(offset) * frame.fur.w;
}
