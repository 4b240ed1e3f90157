// pelage_lighting::Shading::shade in f32: the same terms under the same names, and the same guards. See there for the sources.

// sin(angle)^(2 half_power) from the angle's cosine; clamped before the root, and pow(0, 0) = 1.
fn sine_power(cosine: f32, half_power: f32) -> f32 {
    let c = clamp(cosine, -1.0, 1.0);
    return min(pow(max((1.0 - c) * (1.0 + c), 1e-30), half_power), 1.0);
}

// Where a cosine lies along an axis of the table.
fn table_position(cosine: f32, by_angle: f32) -> f32 {
    let c = clamp(cosine, -1.0, 1.0);
    let angle = 1.0 - acos(c) * 0.318309886;
    return select(0.5 + 0.5 * c, angle, by_angle > 0.5) * frame.table.x + frame.table.y;
}

// The diffuse and the specular factor for u = T·L and v = T·H.
fn factors(u: f32, v: f32) -> vec2f {
#if TABLE
    let at = vec2f(table_position(u, frame.table.z), table_position(v, frame.table.w));
    return textureSampleLevel(factor_table, table_sampler, at, 0.0).xy;
#else
    return vec2f(sine_power(u, frame.diffuse.w), sine_power(v, frame.specular.w));
#endif
}

// H, and the weight that fades where |L + V| is lost in rounding.
fn half_vector(light: vec3f, view: vec3f) -> vec4f {
    let sum = light + view;
    let size = length(sum);
    return vec4f(sum / max(size, 1e-20), min(size * 1e3, 1.0));
}

fn floored(optical_depth: f32) -> f32 {
    return frame.shadow.y + (1.0 - frame.shadow.y) * exp(-optical_depth);
}

// pelage_coat::Irradiance::at.
fn irradiance(n: vec3f) -> vec3f {
#if SKY
    // From above and from below alone.
    return max(frame.irradiance[0].xyz + frame.irradiance[1].xyz * n.y, vec3f(0.0));
#else
    let even = frame.irradiance[0].xyz + frame.irradiance[6].xyz * (3.0 * n.z * n.z - 1.0) + frame.irradiance[8].xyz * (n.x * n.x - n.y * n.y);
    let mixed = frame.irradiance[4].xyz * (n.x * n.y) + frame.irradiance[5].xyz * (n.y * n.z) + frame.irradiance[7].xyz * (n.x * n.z);
    return max(even + mixed + frame.irradiance[1].xyz * n.y + frame.irradiance[2].xyz * n.z + frame.irradiance[3].xyz * n.x, vec3f(0.0));
#endif
}

// Ka · irradiance(N) · sky(depth).
fn ambient_light(normal: vec3f, depth: f32) -> vec3f {
    return frame.ambient.xyz * irradiance(normal) * floored(frame.shadow.w * depth);
}

// How far round the skin the light reaches.
fn facing(n_dot_l: f32) -> f32 {
    let t = clamp((n_dot_l - frame.facing.y) * frame.facing.z, 0.0, 1.0);
    return 1.0 + frame.facing.x * (t * t * (3.0 - 2.0 * t) - 1.0);
}

// The optical depth of the whole length of the fur towards the light.
fn slanted_density(n_dot_l: f32) -> f32 {
    return frame.shadow.x / max(n_dot_l, frame.shadow.z);
}

// shadow(depth, N·L) · facing(N·L) · light.
fn direct_light(light: u32, normal: vec3f, depth: f32) -> vec3f {
    let n_dot_l = dot(normal, frame.lights[light].direction.xyz);
    return frame.lights[light].colour.xyz * facing(n_dot_l) * floored(slanted_density(n_dot_l) * depth);
}

// Kd · diffuse + Ks · specular.
fn reflected(factor: vec2f) -> vec3f {
    return frame.diffuse.xyz * factor.x + frame.specular.xyz * factor.y;
}

// What a hair sends on of a light, before its shadow: reflected(u, v · w).
fn hair_response(light: u32, direction: vec3f, toward_eye: vec3f) -> vec3f {
    let half = half_vector(frame.lights[light].direction.xyz, toward_eye);
    return reflected(factors(dot(direction, frame.lights[light].direction.xyz), dot(direction, half.xyz)) * vec2f(1.0, half.w));
}

// The lights from `first` on, on a hair of albedo 1.
fn lights_from(first: u32, direction: vec3f, normal: vec3f, toward_eye: vec3f, depth: f32) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = first; i < LIGHTS; i++) {
        sum += hair_response(i, direction, toward_eye) * direct_light(i, normal, depth);
    }
    return sum;
}

// The light that bare skin of albedo 1 sends out, where so much of the first light gets to.
fn skin_light(normal: vec3f, shadow: f32) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < LIGHTS; i++) {
        let reach = clamp(dot(normal, frame.lights[i].direction.xyz), 0.0, 1.0) * select(1.0, shadow, i == 0u);
        sum += frame.lights[i].colour.xyz * reach;
    }
    return frame.ambient.xyz * irradiance(normal) + frame.diffuse.xyz * sum;
}
