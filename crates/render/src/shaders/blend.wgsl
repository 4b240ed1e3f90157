// L16: two levels of detail blended on the tile: every second image towards the coarser level's, the ones between towards nothing.

struct Slot {
    fine: u32,
    coarse: u32,      // none: 0xffffffff
    fine_opacity: f32,
    fine_layers: f32,
    coarse_opacity: f32,
    coarse_layers: f32,
    blend: f32,       // 0: fine, 1: coarse
    unused: f32,
};

@group(0) @binding(0) var images: texture_2d_array<f32>;
@group(0) @binding(1) var blended: texture_storage_2d_array<rgba8unorm, write>;
@group(0) @binding(2) var<uniform> slots: array<Slot, 256>;

fn encoded(linear: vec3f) -> vec3f {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3f(0.0)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3f(0.0031308));
}

fn shown(at: vec2u, image: u32, opacity: f32, layers: f32) -> vec4f {
    let hair = textureLoad(images, at, image, 0);
    if opacity == 1.0 && layers == 1.0 {
        return hair;
    }
    return thickened_hair(hair, opacity, layers);
}

@compute @workgroup_size(8, 8)
fn blend(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(blended);
    if id.x >= size.x || id.y >= size.y {
        return;
    }
    let slot = slots[id.z];
    let fine = shown(id.xy, slot.fine, slot.fine_opacity, slot.fine_layers);
    var coarse = vec4f(0.0);
    if slot.coarse != 0xffffffffu {
        coarse = shown(id.xy, slot.coarse, slot.coarse_opacity, slot.coarse_layers);
    }
    let hair = mix(fine, coarse, slot.blend);
    textureStore(blended, id.xy, id.z, vec4f(encoded(hair.rgb), hair.a));
}
