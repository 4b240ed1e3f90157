// L12, L17, N2: the furred faces once for each shell, offset along the hair's curve, from the innermost out: one instanced draw.

struct ShellVertex {
    @builtin(position) position: vec4f,
    @location(0) tile: vec3f,  // tile coordinates, levels of blur
    @location(1) light: vec3f,  // the light, or what of it is not in `direct`
    @location(2) @interpolate(flat) shell: u32,  // place among the shells
#if KEPT
    @location(3) kept: vec2f,  // growth, what a cut leaves
#endif
#if SPLIT
    @location(4) direct: vec3f,  // the first light, its response yet to be multiplied where it is lit at pixels
#endif
#if PIXEL
    @location(12) cosines: vec3f,  // u, v, weight of the half vector
#endif
#if MAP
    @location(5) light_in_tile: vec4f,  // L and H along the tile's axes, and the hair along s and t
    @location(6) half_in_tile: vec4f,
#endif
#if MARCH
    @location(7) inward: vec3f,  // the view's way in, in tiles and heights
    @location(8) light_below: vec3f,  // at the lowest layer of the march
#if SPLIT
    @location(9) direct_below: vec3f,
#endif
#endif
#if HAIR_SHADOW
    @location(10) toward_light: vec3f,  // in tiles and heights
#endif
#if SHADOW_MAP
    @location(11) in_light: vec3f,  // where on the shadow map, distance
#endif
#if MIXED
    @location(13) mix: f32,  // between the first mixture of hair and the last
#endif
#if LAPPED
    @location(14) opacity: f32,  // of a patch that overlaps others (L6)
#endif
};

// How far apart, in pixels, a strand's places in this layer and the next are.
fn step_on_screen(clip: vec4f, step: vec3f) -> f32 {
    let next = clip + frame.clip_from_coat * vec4f(step, 0.0);
    return length((next.xy / max(next.w, 1e-6) - clip.xy / max(clip.w, 1e-6)) * frame.screen.xy);
}

// The levels of detail by which the sampler's own is off.
//
// At a grazing angle a strand's footprints in this layer and the next are thin and apart, and it would be a row of dots: blurred until they meet.
// Where the texture is magnified the blur is used up before it shows.
//
// At a slant a texel's footprint is long and thin, and the sampler takes its level from the long side: all detail across is lost. The mean of the
// two sides' levels keeps strands apart, and what aliases along is averaged by the layers, as long as those are less than a pixel apart; else their steps would
// show as a hatch. Half the logarithm of the sides' ratio, N·V, to two levels' worth.
fn level_bias(step: f32, n_dot_v: f32) -> f32 {
    let blur = clamp(log2(max(step, 1.0)), 0.0, frame.screen.z);
    let sharpening = 0.5 * log2(clamp(n_dot_v, 0.25, 1.0));
    return blur + sharpening * clamp(2.0 - 2.0 * step, 0.0, 1.0);
}

#if AXES
// A way as long as the hair, in the tile's own axes: along s and t in tiles, along the hair in heights. `s` is ∂p/∂s.
fn in_tile(direction: vec3f, s: vec3f, normal: vec3f, along: vec3f) -> vec3f {
    let rise = dot(along, normal);
    let way = direction * length(along);
    let heights = dot(way, normal) / select(rise, 1e-9, abs(rise) < 1e-9);
    let flat = way - heights * along;
    return vec3f(dot(flat, s), dot(flat, cross(normal, s)), heights * dot(s, s)) / max(dot(s, s), 1e-20);
}

// Tiles aside for each height: at a grazing angle no more than ten lengths of hair.
fn aside(way: vec3f, least: f32) -> vec2f {
    return way.xy / max(abs(way.z), least);
}
#endif

@vertex
fn shell_vertex(
    @location(0) index: u32, @location(1) tile: vec2f, @location(2) tangent: u32, @location(3) tile_side: f32,
    @location(4) patch_vertex: u32, @location(5) instance: u32,
#if LAPPED
    @location(6) opacity: f32,
#endif
) -> ShellVertex {
#if INSTANCED
    place_number = instance >> 8u;
    let place_among = instance & 255u;
#else
    let place_among = instance;
#endif
    let shell = shells[place_among];
    let v = vertex_at(index);
    let place = v.position + curve(v, shell.top);
    let clip = frame.clip_from_coat * vec4f(place, 1.0);
#if PATCH
    // One light for the whole patch: that of the vertex in its middle.
    let lit = vertex_at(patch_vertex);
    let lit_place = lit.position + curve(lit, shell.top);
#else
    let lit = v;
    let lit_place = place;
#endif
    let toward_eye = normalize(frame.eye.xyz - lit_place);
    let direction = direction_at(lit, shell.top_light);
    let depth = 1.0 - shell.top_light;
    let toward_light = frame.lights[0].direction.xyz;
    let half = half_vector(toward_light, toward_eye);
    var out: ShellVertex;
    out.position = clip;
    let step = step_on_screen(clip, slope(v, shell.top) * shell.step);
    let blur = level_bias(step, dot(v.normal, normalize(frame.eye.xyz - place)));
    out.tile = vec3f(tile, blur);
    out.shell = place_among;
#if MIXED
    out.mix = v.mix;
#endif
#if LAPPED
    out.opacity = opacity;
#endif
#if KEPT
    out.kept = vec2f(growth_of(v.offset), cut_of(v.end, shell.top));
#endif
#if SPLIT
    out.light = v.colour * (ambient_light(lit.normal, depth) + lights_from(1u, direction, lit.normal, toward_eye, depth));
    out.direct = v.colour * first_light(lit, direction, toward_eye, depth);
#else
    out.light = v.colour * (ambient_light(lit.normal, depth) + lights_from(0u, direction, lit.normal, toward_eye, depth));
#endif
#if PIXEL
    out.cosines = vec3f(dot(direction, toward_light), dot(direction, half.xyz), half.w);
#endif
#if AXES
    let along = slope(v, shell.top);
#if INSTANCED
    let s = in_world(vec4f(tile_side * unpack_direction(tangent), 0.0));
#else
    let s = tile_side * unpack_direction(tangent);
#endif
#endif
#if MAP
    let axes = mat3x3f(normalize(s), normalize(cross(v.normal, s)), along / max(length(along), 1e-20));
    out.light_in_tile = vec4f(toward_light * axes, dot(axes[0], axes[2]));
    out.half_in_tile = vec4f(half.xyz * axes, dot(axes[1], axes[2]));
#endif
#if MARCH
    out.inward = in_tile(place - frame.eye.xyz, s, v.normal, along) / max(distance(place, frame.eye.xyz), 1e-20);
    let depth_below = 1.0 - shell.bottom_light;
#if SPLIT
    out.light_below = v.colour
        * (ambient_light(lit.normal, depth_below) + lights_from(1u, direction, lit.normal, toward_eye, depth_below));
    out.direct_below = v.colour * first_light(lit, direction, toward_eye, depth_below);
#else
    out.light_below = v.colour
        * (ambient_light(lit.normal, depth_below) + lights_from(0u, direction, lit.normal, toward_eye, depth_below));
#endif
#endif
#if HAIR_SHADOW
    out.toward_light = in_tile(toward_light, s, v.normal, along);
#endif
#if SHADOW_MAP
    out.in_light = place_in_light(place, v.normal, length(v.offset) * (1.0 - shell.top));
#endif
    return out;
}

#if SPLIT
// The first light: whole where it is lit at vertices, without the hair's response where that is for each pixel to say.
fn first_light(v: Vertex, direction: vec3f, toward_eye: vec3f, depth: f32) -> vec3f {
    let light = direct_light(0u, v.normal, depth);
#if PIXEL
    return light;
#else
    return light * hair_response(0u, direction, toward_eye);
#endif
}
#endif

#if MAP
// A texel of the direction map.
fn direction_texel(tile: vec2f, image: u32, blur: f32) -> vec3f {
#if MIXED
    return mixed_image(hair_directions, tile, image, blur).xyz;
#else
    return textureSampleBias(hair_directions, tile_sampler, tile, image, blur).xyz;
#endif
}

// Which way the hair goes, from 0 to 1 along each axis; `images` are those of this level and of the one it becomes.
fn mapped_direction(tile: vec2f, images: u32, blur: f32) -> vec3f {
    var direction = direction_texel(tile, images & 0xffffu, blur);
#if LEVELS
    direction = mix(direction, direction_texel(tile, images >> 16u, blur), later());
#endif
    return direction;
}
#endif

#if HAIR_SHADOW
// K10: what a shell further out covers of the way to the light.
fn covered_by(in: ShellVertex, tile: vec2f, place_among: u32, above: u32) -> f32 {
    let rise = shells[above].height - shells[place_among].height;
    let over = tile + aside(in.toward_light, 0.15) * rise;
    let covered = hair_at(over, above, in.tile.z).a;
    // Nothing is above the outermost.
    return covered * select(0.0, 1.0, in.toward_light.z > 0.0 && rise > 0.0);
}

// The same, while one level of detail becomes the next.
fn shaded(in: ShellVertex, tile: vec2f, place_among: u32) -> f32 {
    let above = shells[place_among].above;
    var covered = covered_by(in, tile, place_among, above & 0xffffu);
#if LEVELS
    covered = mix(covered, covered_by(in, tile, place_among, above >> 16u), later());
#endif
    return covered;
}
#endif

#if MAP
// What scales a direction of the map, laid along axes of which the hair's, u, is not upright to the others, to the length that the map says: else hair that leans
// the way it is combed would be longer than 1, and dark.
fn laid_length(mapped: vec3f, lean: vec2f) -> f32 {
    let squared = dot(mapped, mapped);
    return sqrt(squared / max(squared + 2.0 * mapped.z * dot(mapped.xy, lean), 1e-3 * squared + 1e-12));
}
#endif

#if SPLIT
// How much of the first light a pixel sends on.
fn first_response(in: ShellVertex, tile: vec2f, place_among: u32) -> vec3f {
    var response = vec3f(1.0);
#if PIXEL
    var cosines = in.cosines.xy;
#if MAP
    let mapped = mapped_direction(tile, shells[place_among].images, in.tile.z) * 2.0 - 1.0;
    cosines = vec2f(dot(mapped, in.light_in_tile.xyz), dot(mapped, in.half_in_tile.xyz))
        * laid_length(mapped, vec2f(in.light_in_tile.w, in.half_in_tile.w));
#endif
    response = reflected(factors(cosines.x, cosines.y) * vec2f(1.0, in.cosines.z));
#endif
#if HAIR_SHADOW
    response *= 1.0 - frame.facing.w * shaded(in, tile, place_among);
#endif
#if SHADOW_MAP
    response *= shadow_at(in.in_light);
#endif
    return response;
}
#endif

fn shell_light(in: ShellVertex, tile: vec2f, place_among: u32) -> vec3f {
#if SPLIT
    return in.light + in.direct * first_response(in, tile, place_among);
#else
    return in.light;
#endif
}

#if MARCH
// L26, N9: this shell and the layers under it, as the ray of sight meets them, down to the next shell that is drawn.
fn shell_colour(in: ShellVertex) -> vec4f {
#if MIXED
    set_mixture(in.mix);
#endif
    let steps = u32(frame.screen.w);
    let slide = aside(in.inward, 0.1);
    let top = shells[in.shell].top;
    let depth = max(top - shells[in.shell].bottom, 1e-6);
    var sum = vec4f(0.0);
    for (var i = 0u; i < u32(frame.casting.w) * steps; i++) {
        let layer = i32(in.shell) - i32(i / steps);
        // Below the innermost there is the skin.
        let there = select(0.0, 1.0, layer >= 1);
        let upper = u32(max(layer, 1));
        let below = u32(max(layer - 1, 1));
        let between = f32(i % steps) / f32(steps);
        let height = mix(shells[upper].height, shells[below].height, between);
        let tile = in.tile.xy + slide * (top - height);
        var hair = hair_at(tile, upper, in.tile.z) * shells[upper].asked;
        if steps > 1u {
            // A sample of the volume between two layers stands for a part of one.
            hair = mix(hair, hair_at(tile, below, in.tile.z) * shells[below].asked, between);
            hair = thickened_hair(hair, 1.0, 1.0 / f32(steps));
        }
        hair *= kept(in, top - height);
        let share = clamp((top - height) / depth, 0.0, 1.0);
        var light = mix(in.light, in.light_below, share);
#if SPLIT
        light += mix(in.direct, in.direct_below, share) * first_response(in, tile, upper);
#endif
        sum += (1.0 - sum.a) * there * vec4f(hair.rgb * light, hair.a);
    }
    return sum;
}
#else
fn shell_colour(in: ShellVertex) -> vec4f {
#if MIXED
    set_mixture(in.mix);
#endif
    let hair = hair_at(in.tile.xy, in.shell, in.tile.z) * kept(in, 0.0);
    return vec4f(hair.rgb * shell_light(in, in.tile.xy, in.shell), hair.a);
}
#endif

// How much of its fur a place has left, so far below its shell.
fn kept(in: ShellVertex, below: f32) -> f32 {
    var left = 1.0;
#if KEPT
    let kept = clamp(in.kept + vec2f(0.0, below * frame.fur.y), vec2f(0.0), vec2f(1.0));
    left = kept.x * kept.y;
#endif
#if LAPPED
    left *= in.opacity;
#endif
    return left;
}

// Depth written where there is hair (Lengyel et al. 2001, section 2.3).
@fragment
fn shell_tested(in: ShellVertex) -> @location(0) vec4f {
    let colour = shell_colour(in);
    if colour.a < frame.fur.z {
        discard;
    }
    return colour;
}

// Depth only tested (NVIDIA's sample).
@fragment
fn shell_blended(in: ShellVertex) -> @location(0) vec4f {
    return shell_colour(in);
}

struct Covered {
    @location(0) colour: vec4f,
    @builtin(sample_mask) samples: u32,
};

// Opacity as the share of a pixel's samples: no blending, and no order that matters. Which samples differs from pixel to pixel and from shell to shell, or
// shells would cover the same ones over and over (Enderton et al. 2010, *Stochastic transparency*); a device's own alpha to coverage has one pattern for all.
@fragment
fn shell_covering(in: ShellVertex) -> Covered {
    let colour = shell_colour(in);
    if colour.a < frame.fur.z {
        discard;
    }
    // Interleaved gradient noise (Jimenez 2014) over pixels, steps of the golden and the plastic ratio over shells.
    let pixel = fract(52.9829189 * fract(dot(floor(in.position.xy), vec2f(0.06711056, 0.00583715))));
    let shell = f32(in.shell);
    let count = min(u32(colour.a * f32(SAMPLES) + fract(pixel + shell * 0.61803399)), SAMPLES);
    let first = u32(fract(7.0 * pixel + shell * 0.7548777) * f32(SAMPLES));
    let samples = ((1u << count) - 1u) << first;
    return Covered(vec4f(colour.rgb / colour.a, 1.0), (samples | (samples >> SAMPLES)) & ((1u << SAMPLES) - 1u));
}
