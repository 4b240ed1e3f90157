// How much of the first light comes through what stands before it.

// The slices of the map behind the first hair, in lengths of the fur.
const SLICES = vec4f(0.25, 0.5, 1.0, 2.0);

// Where the light comes out of a hair's own fur, on the map, and how far that is from the light. What that fur itself takes is the self-shadow's business.
fn place_in_light(place: vec3f, normal: vec3f, length_above: f32) -> vec3f {
    let toward_light = frame.lights[0].direction.xyz;
    let way = length_above / max(dot(normal, toward_light), 0.25) + frame.casting.z;
    let at = frame.light_from_coat * vec4f(place + toward_light * way + normal * frame.casting.z, 1.0);
    return vec3f(at.xy * vec2f(0.5, -0.5) + 0.5, at.z);
}

#if SHADOW_MAP
// How far the first hair is from the light: the mean of the four texels around, of those that hair covers. The others say 1, and a mean with them would let light
// through all along an outline.
fn first_hair(at: vec2f) -> f32 {
    let fronts = textureGather(0, shadow_fronts, table_sampler, at);
    let f = fract(at * vec2f(textureDimensions(shadow_fronts)) - 0.5);
    // In the order of the gathered texels: from the lower left anticlockwise, y down.
    let weights = vec4f((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y)) * vec4f(fronts < vec4f(1.0));
    return select(1.0, dot(weights, fronts) / max(dot(weights, vec4f(1.0)), 1e-6), dot(weights, vec4f(1.0)) > 0.0);
}
#endif

fn shadow_at(at: vec3f) -> f32 {
#if SHADOW_MAP
    let lit = textureSampleCompareLevel(shadow_skin, shadow_sampler, at.xy, at.z);
    let slices = textureSampleLevel(shadow_slices, table_sampler, at.xy, 0.0);
    let behind = (at.z - first_hair(at.xy)) / max(frame.casting.x, 1e-6);
    let before = vec4f(0.0, SLICES.xyz);
    let reached = clamp((vec4f(behind) - before) / (SLICES - before), vec4f(0.0), vec4f(1.0));
    let optical_depth = dot(slices - vec4f(0.0, slices.xyz), reached);
    return frame.shadow.y + (1.0 - frame.shadow.y) * lit * exp(-optical_depth);
#else
    return 1.0;
#endif
}
