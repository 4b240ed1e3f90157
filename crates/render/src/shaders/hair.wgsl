// What a shell shows.

#if LEVELS
// How far one level of detail has become the next (L16).
fn later() -> f32 {
    return frame.toward_eye.w;
}
#endif

// A shell's image at a place of the tile; while levels blend, every second one's towards that of the next level, and of those between towards nothing.
fn hair_at(tile: vec2f, place_among: u32, bias: f32) -> vec4f {
    let shell = shells[place_among];
    var hair = textureSampleBias(shell_images, tile_sampler, tile, shell.images & 0xffffu, bias);
#if THICKENED
    hair = thickened_hair(hair, shell.opacity, shell.layers);
#endif
#if LEVELS
    var coarse = vec4f(0.0);
    // A shell that fades fetches once. One triangle is of one shell, so that the four pixels which a level of detail is taken from go the same way.
    if shell.later_opacity > 0.0 {
        coarse = textureSampleBias(shell_images, tile_sampler, tile, shell.images >> 16u, bias);
#if THICKENED
        coarse = thickened_hair(coarse, shell.later_opacity, shell.later_layers);
#endif
    }
    hair = mix(hair, coarse, later());
#endif
    return hair;
}
