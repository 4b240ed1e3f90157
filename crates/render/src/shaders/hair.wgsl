// What a shell shows.

#if LEVELS
// How far one level of detail has become the next (L16).
fn later() -> f32 {
    return frame.toward_eye.w;
}
#endif

#if MIXED
// Between which two mixtures of hair a fragment is (L24): how many come before, and how far it is from that to the next. Set first by the fragment shaders.
var<private> mixtures_before: u32;
var<private> to_next_mixture: f32;

// A share of the way that is no more than rounding: where a triangle is of one mixture, the other is not fetched.
const NO_SHARE = 0.002;

fn set_mixture(mix: f32) {
    let place = clamp(mix, 0.0, 1.0) * frame.mixes.y;
    let before = min(floor(place + NO_SHARE), frame.mixes.y);
    mixtures_before = u32(before);
    to_next_mixture = max(place - before, 0.0);
}

// A texel of a stack, with what the next mixture has there: hair that both have stays whole, of the rest each shows its share.
fn mixed_image(stack: texture_2d_array<f32>, tile: vec2f, image: u32, bias: f32) -> vec4f {
    let place = image + mixtures_before * u32(frame.mixes.x);
    let texel = textureSampleBias(stack, tile_sampler, tile, place, bias);
    // Taken by all four pixels, as not all of them may go on.
    let across = dpdx(tile);
    let down = dpdy(tile);
    if to_next_mixture < NO_SHARE {
        return texel;
    }
    let size = exp2(bias);
    return mix(texel, textureSampleGrad(stack, tile_sampler, tile, place + u32(frame.mixes.x), across * size, down * size), to_next_mixture);
}
#endif

// A texel of the shells.
fn shell_texel(tile: vec2f, image: u32, bias: f32) -> vec4f {
#if MIXED
    return mixed_image(shell_images, tile, image, bias);
#else
    return textureSampleBias(shell_images, tile_sampler, tile, image, bias);
#endif
}

// A shell's image at a place of the tile; while levels blend, every second one's towards that of the next level, and of those between towards nothing.
fn hair_at(tile: vec2f, place_among: u32, bias: f32) -> vec4f {
    let shell = shells[place_among];
    var hair = shell_texel(tile, shell.images & 0xffffu, bias);
#if THICKENED
    hair = thickened_hair(hair, shell.opacity, shell.layers);
#endif
#if LEVELS
    var coarse = vec4f(0.0);
    // A shell that fades fetches once. One triangle is of one shell, so that the four pixels which a level of detail is taken from go the same way.
    if shell.later_opacity > 0.0 {
        coarse = shell_texel(tile, shell.images >> 16u, bias);
#if THICKENED
        coarse = thickened_hair(coarse, shell.later_opacity, shell.later_layers);
#endif
    }
    hair = mix(hair, coarse, later());
#endif
    return hair;
}
