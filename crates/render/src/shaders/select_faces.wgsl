// K18: the faces of which a shell can be seen: those of which, at no height of the fur, all is outside of one side of the view, nor the back is
// shown, nor all is behind what is in the depth buffer already.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> skin: array<vec4u>;
@group(0) @binding(2) var<storage, read> fur: array<vec4u>;
@group(0) @binding(3) var<storage, read> looks: array<vec4u>;
@group(0) @binding(4) var<storage, read> tiles: array<u32>;  // patch vertices, six words each

#if HIDDEN
@group(0) @binding(5) var<storage, read> furthest: array<f32>;  // pyramid.rs: size, levels, pixels, then level by level
#endif

// A corner's hair in homogeneous coordinates, as the powers of its height: at (h) = x + y h + z h².
struct Column {
    x: vec4f,
    y: vec4f,
    z: vec4f,
};

fn column(v: Vertex) -> Column {
    return Column(
        frame.clip_from_coat * vec4f(v.position, 1.0),
        frame.clip_from_coat * vec4f(v.offset - v.bend, 0.0),
        frame.clip_from_coat * vec4f(v.bend, 0.0));
}

// Whether something lies inside of a side of the view (a half-space of homogeneous coordinates): of a parabola, one of its control points.
fn inside(c: Column, side: vec4f) -> bool {
    let root = dot(c.x, side);
    let bend = root + 0.5 * dot(c.y, side);
    return root >= 0.0 || bend >= 0.0 || root + dot(c.y, side) + dot(c.z, side) >= 0.0;
}

struct Face {
    a: Column,
    b: Column,
    c: Column,
};

fn in_view(face: Face) -> bool {
    var sides = array<vec4f, 6>(
        vec4f(1.0, 0.0, 0.0, 1.0), vec4f(-1.0, 0.0, 0.0, 1.0), vec4f(0.0, 1.0, 0.0, 1.0), vec4f(0.0, -1.0, 0.0, 1.0),
        vec4f(0.0, 0.0, 1.0, 0.0), vec4f(0.0, 0.0, -1.0, 1.0));
    for (var i = 0u; i < 6u; i++) {
        if !(inside(face.a, sides[i]) || inside(face.b, sides[i]) || inside(face.c, sides[i])) {
            return false;
        }
    }
    return true;
}

// (x, y, w): what decides which side of a triangle is seen.
fn seen(v: vec4f) -> vec3f {
    return v.xyw;
}

// Whether the face shows its front at some height. It shows it where det(P, Q − P, R − P) > 0, a polynomial of the sixth degree in the height, which is
// nowhere above the greatest of its Bernstein coefficients.
fn shows_front(face: Face, ab: Column, ac: Column) -> bool {
    var p = array<vec3f, 3>(seen(face.a.x), seen(face.a.y), seen(face.a.z));
    var q = array<vec3f, 3>(seen(ab.x), seen(ab.y), seen(ab.z));
    var r = array<vec3f, 3>(seen(ac.x), seen(ac.y), seen(ac.z));
    var normal = array<vec3f, 5>();
    for (var i = 0u; i < 3u; i++) {
        for (var j = 0u; j < 3u; j++) {
            normal[i + j] += cross(q[i], r[j]);
        }
    }
    var power = array<f32, 7>();
    for (var i = 0u; i < 3u; i++) {
        for (var j = 0u; j < 5u; j++) {
            power[i + j] += dot(p[i], normal[j]);
        }
    }
    // C(j, i) / C(6, i), row by row.
    var greatest = -1e30;
    for (var j = 0u; j < 7u; j++) {
        var coefficient = 0.0;
        var weight = 1.0;
        for (var i = 0u; i <= j; i++) {
            coefficient += weight * power[i];
            weight *= f32(j - i) / f32(6u - i);
        }
        greatest = max(greatest, coefficient);
    }
    // What rounding may be off by.
    let size = (length(p[0]) + length(p[1]) + length(p[2])) * (length(q[0]) + length(q[1]) + length(q[2])) * (length(r[0]) + length(r[1]) + length(r[2]));
    return greatest > -1e-6 * size;
}

#if HIDDEN
// A column's control points, which hold it between them.
fn control(c: Column) -> array<vec4f, 3> {
    return array<vec4f, 3>(c.x, c.x + 0.5 * c.y, c.x + c.y + c.z);
}

// Whether all of it is behind what can be seen furthest in the squares that it takes on the screen. Where a corner is not before the eye, nobody knows.
fn is_hidden(face: Face) -> bool {
    var least = vec2f(1e30);
    var most = vec2f(-1e30);
#if REVERSED
    var nearest = 0.0;
#else
    var nearest = 1.0;
#endif
    var columns = array<Column, 3>(face.a, face.b, face.c);
    for (var i = 0u; i < 3u; i++) {
        var points = control(columns[i]);
        for (var j = 0u; j < 3u; j++) {
            if points[j].w <= 1e-6 {
                return false;
            }
            let place = points[j].xyz / points[j].w;
            least = min(least, place.xy);
            most = max(most, place.xy);
#if REVERSED
            nearest = max(nearest, place.z);
#else
            nearest = min(nearest, place.z);
#endif
        }
    }
    // Pixels, y down, and one more on each side for what rounding may move.
    let sides = bitcast<u32>(furthest[3]);
    let pixels = vec2f(f32(sides & 0xffffu), f32(sides >> 16u));
    let low = clamp((0.5 * vec2f(least.x, -most.y) + 0.5) * pixels - 1.0, vec2f(0.0), pixels);
    let high = clamp((0.5 * vec2f(most.x, -least.y) + 0.5) * pixels + 1.0, vec2f(0.0), pixels);
    // The level at which it takes two squares or so a side.
    let squares = max(high.x - low.x, high.y - low.y) / 8.0;
    var dimensions = vec2u(bitcast<u32>(furthest[0]), bitcast<u32>(furthest[1]));
    let level = min(u32(ceil(max(log2(max(squares, 1.0)) - 1.0, 0.0))), bitcast<u32>(furthest[2]) - 1u);
    var start = 4u;
    for (var i = 0u; i < level; i++) {
        start += dimensions.x * dimensions.y;
        dimensions = (dimensions + 1u) / 2u;
    }
    let size = f32(8u << level);
    let last = dimensions - 1u;
    let first = min(vec2u(low / size), last);
    let end = min(vec2u(high / size), last);
    for (var y = first.y; y <= end.y; y++) {
        for (var x = first.x; x <= end.x; x++) {
            let seen = furthest[start + y * dimensions.x + x];
#if REVERSED
            if nearest * (1.0 + 1e-5) >= seen {
                return false;
            }
#else
            if nearest - 1e-6 <= seen {
                return false;
            }
#endif
        }
    }
    return true;
}
#endif

fn minus(a: Vertex, b: Vertex) -> Column {
    return Column(
        frame.clip_from_coat * vec4f(a.position - b.position, 0.0),
        frame.clip_from_coat * vec4f((a.offset - a.bend) - (b.offset - b.bend), 0.0),
        frame.clip_from_coat * vec4f(a.bend - b.bend, 0.0));
}

fn face_is_seen(face: u32) -> bool {
    let a = vertex_at(tiles[6u * items[3u * face]]);
    let b = vertex_at(tiles[6u * items[3u * face + 1u]]);
    let c = vertex_at(tiles[6u * items[3u * face + 2u]]);
    let columns = Face(column(a), column(b), column(c));
#if HIDDEN
    return in_view(columns) && shows_front(columns, minus(b, a), minus(c, a)) && !is_hidden(columns);
#else
    return in_view(columns) && shows_front(columns, minus(b, a), minus(c, a));
#endif
}

fn kept(face: u32) -> u32 {
    return select(0u, 1u, face_is_seen(face));
}
