// What stands between the first light and the fur, seen from the light: the skin's depth, how far the first hair is, and how much hair there is up to
// four distances behind it (Yuksel and Keyser 2008, *Deep opacity maps*).

struct SkinVertex {
    @builtin(position) position: vec4f,
};

@vertex
fn shadow_skin_vertex(@location(0) index: u32) -> SkinVertex {
    return SkinVertex(frame.light_from_coat * vec4f(vertex_at(index).position, 1.0));
}

struct ShadowVertex {
    @builtin(position) position: vec4f,
    @location(0) tile: vec4f,  // tile coordinates, growth, what a cut leaves
    @location(1) @interpolate(flat) shell: u32,
#if MIXED
    @location(2) mix: f32,
#endif
};

@vertex
fn shadow_shell_vertex(
    @location(0) index: u32, @location(1) tile: vec2f, @location(2) tangent: u32, @location(3) tile_side: f32,
    @location(4) patch_vertex: u32, @location(5) place_among: u32,
) -> ShadowVertex {
    let height = shells[place_among].height;
    let v = vertex_at(index);
    var out: ShadowVertex;
    out.position = frame.light_from_coat * vec4f(v.position + curve(v, height), 1.0);
    out.tile = vec4f(tile, growth_of(v.offset), cut_of(v.end, height));
    out.shell = place_among;
#if MIXED
    out.mix = v.mix;
#endif
    return out;
}

fn opacity_of(in: ShadowVertex) -> f32 {
#if MIXED
    set_mixture(in.mix);
#endif
    // A shell that casts stands for those that are left out below it.
    return thickened(hair_at(in.tile.xy, in.shell, 0.0).a, frame.casting.y) * clamp(in.tile.z, 0.0, 1.0) * clamp(in.tile.w, 0.0, 1.0);
}

// Blended by the minimum.
@fragment
fn shadow_front(in: ShadowVertex) -> @location(0) vec4f {
    let opacity = opacity_of(in);
    if opacity < 0.05 {
        discard;
    }
    return vec4f(in.position.z, 0.0, 0.0, 0.0);
}

// Optical depth, added up.
@fragment
fn shadow_opacity(in: ShadowVertex) -> @location(0) vec4f {
    let depth = -log(max(1.0 - opacity_of(in), 0.01));
    let front = textureLoad(shadow_fronts, vec2u(in.position.xy), 0).r;
    return select(vec4f(0.0), vec4f(depth), vec4f(in.position.z - front) <= SLICES * frame.casting.x);
}
