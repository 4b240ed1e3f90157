// Opacity as what a thickness of fur keeps back: the one place that knows how it grows with the thickness.

// What so many layers of an image, or a part of one, cover together.
fn thickened(alpha: f32, layers: f32) -> f32 {
    return 1.0 - pow(max(1.0 - alpha, 0.0), layers);
}

// The same of a premultiplied colour, of which a part is there.
fn thickened_hair(hair: vec4f, part: f32, layers: f32) -> vec4f {
    return hair * (thickened(hair.a * part, layers) / max(hair.a, 1e-6));
}
