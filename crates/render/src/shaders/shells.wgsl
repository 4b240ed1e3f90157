// L12, L17, N2: the furred faces once for each layer, offset by c_v · k / (N − 1), from the innermost out: one instanced draw.

struct ShellVertex {
    @builtin(position) position: vec4f,
    @location(0) tile: vec4f,    // tile coordinates, growth, weight of the half vector
    @location(1) light: vec4f,   // lit at vertices: the light; else its ambient part, and u
    @location(2) direct: vec4f,  // lit at pixels: the direct light, and v
    @location(3) @interpolate(flat) layer: u32,
    @location(4) blur: f32,  // levels
};

// The levels of blur that let a strand's footprints in this layer and the next meet on the screen. At a grazing angle the footprints are thin
// and apart, and a strand would be a row of dots. Where the texture is magnified the blur is used up before it shows.
fn step_blur(clip: vec4f, offset: vec3f) -> f32 {
    let next = clip + frame.clip_from_coat * vec4f(offset * frame.fur.y, 0.0);
    let step = (next.xy / max(next.w, 1e-6) - clip.xy / max(clip.w, 1e-6)) * frame.screen.xy;
    return clamp(log2(max(length(step), 1.0)), 0.0, frame.screen.z);
}

// At a slant a texel's footprint is long and thin, and the sampler takes its level from the long side: all detail across is lost. The mean of
// the two sides' levels keeps strands apart, and what aliases along is averaged by the layers. Half the logarithm of the sides' ratio, N·V, to two
// levels' worth.
fn slant_sharpening(normal: vec3f, toward_eye: vec3f) -> f32 {
    return 0.5 * log2(clamp(dot(normal, toward_eye), 0.25, 1.0));
}

@vertex
fn shell_vertex(@location(0) index: u32, @location(1) tile: vec2f, @builtin(instance_index) layer: u32) -> ShellVertex {
    let v = vertex_at(index);
    let height = f32(layer) * frame.fur.y;
    let place = v.position + v.offset * height;
    let toward_eye = normalize(frame.eye.xyz - place);
    let half = half_vector(toward_eye);
    let cosines = vec2f(dot(v.direction, frame.light.xyz), dot(v.direction, half.xyz));
    var ambient = v.colour * ambient_light(v.normal, 1.0 - height);
    let direct = v.colour * direct_light(dot(v.normal, frame.light.xyz), 1.0 - height);
    if LIGHTING == 0u {
        ambient += direct * reflected(factors(cosines.x, cosines.y) * vec2f(1.0, half.w));
    }
    let clip = frame.clip_from_coat * vec4f(place, 1.0);
    return ShellVertex(
        clip, vec4f(tile, growth_of(v.offset), half.w),
        vec4f(ambient, cosines.x), vec4f(direct, cosines.y), layer, step_blur(clip, v.offset) + slant_sharpening(v.normal, toward_eye));
}

fn shell_colour(in: ShellVertex) -> vec4f {
    let hair = textureSampleBias(shell_layers, tile_sampler, in.tile.xy, in.layer, in.blur) * clamp(in.tile.z, 0.0, 1.0);
    var light = in.light.xyz;
    if LIGHTING != 0u {
        light += in.direct.xyz * reflected(factors(in.light.w, in.direct.w) * vec2f(1.0, in.tile.w));
    }
    return vec4f(hair.rgb * light, hair.a);
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
