// The furthest that can be seen in each square of 8 × 8 pixels, and in squares of squares: what lies behind that is hidden (Greene, Kass and Miller
// 1993, *Hierarchical Z-buffer visibility*). A buffer and no texture, as some drivers read one level of detail for several lanes that want different ones.

struct Level {
    read: vec2u,      // size of what is read: pixels, or the finer level's squares
    written: vec2u,   // squares
    finer: u32,       // where the finer level begins
    place: u32,       // where this level begins
    unused: vec2u,
};

@group(0) @binding(0) var<uniform> level: Level;
@group(0) @binding(1) var<storage, read_write> furthest: array<f32>;
#if FIRST
#if SAMPLES
@group(0) @binding(2) var depth: texture_depth_multisampled_2d;
#else
@group(0) @binding(2) var depth: texture_depth_2d;
#endif
#endif

fn further(a: f32, b: f32) -> f32 {
#if REVERSED
    return min(a, b);
#else
    return max(a, b);
#endif
}

@compute @workgroup_size(8, 8)
fn reduce(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= level.written.x || id.y >= level.written.y {
        return;
    }
#if REVERSED
    var value = 1.0;
#else
    var value = 0.0;
#endif
#if FIRST
    let end = min(8u * id.xy + 8u, level.read);
    for (var y = 8u * id.y; y < end.y; y++) {
        for (var x = 8u * id.x; x < end.x; x++) {
#if SAMPLES
            for (var sample = 0; sample < i32(textureNumSamples(depth)); sample++) {
                value = further(value, textureLoad(depth, vec2u(x, y), sample));
            }
#else
            value = further(value, textureLoad(depth, vec2u(x, y), 0));
#endif
        }
    }
#else
    let end = min(2u * id.xy + 2u, level.read);
    for (var y = 2u * id.y; y < end.y; y++) {
        for (var x = 2u * id.x; x < end.x; x++) {
            value = further(value, furthest[level.finer + y * level.read.x + x]);
        }
    }
#endif
    furthest[level.place + id.y * level.written.x + id.x] = value;
}
