// Shaders for models: light from one side and ambient light, translucent leaves, and shadows.

const shared = `#version 300 es
precision highp float;
precision highp sampler2DShadow;
`;

export const modelVertex = `${shared}
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour; // square roots of linear values; the last is 1 for leaves
uniform mat4 eye;
uniform mat4 sun;
uniform float nudge; // offset of shadows from the surface, in steps
out vec3 at;
out vec3 out_of;
out vec4 hue;
out vec4 lit_at;
void main() {
    at = position;
    out_of = normal;
    hue = vec4(colour.rgb * colour.rgb, colour.a);
    lit_at = sun * vec4(position + normal * nudge, 1.0);
    gl_Position = eye * vec4(position, 1.0);
}`;

// The share of sunlight that reaches a place, from four samples around it.
const shade = `
uniform sampler2DShadow shadows;
uniform float texel;
float sunshine(vec4 place, float bias) {
    vec3 look = place.xyz / place.w * 0.5 + 0.5;
    if (any(lessThan(look, vec3(0.0))) || any(greaterThan(look, vec3(1.0)))) return 1.0;
    look.z -= bias;
    float sum = 0.0;
    for (int index = 0; index < 4; ++index) {
        vec2 away = vec2(float(index & 1) - 0.5, float(index >> 1) - 0.5) * 1.6 * texel;
        sum += texture(shadows, vec3(look.xy + away, look.z));
    }
    return sum / 4.0;
}
float grain(vec2 place) { // for the transition between two models
    return fract(52.9829189 * fract(dot(place, vec2(0.06711056, 0.00583715))));
}
vec3 shown(vec3 linear) {
    vec3 bounded = linear / (1.0 + max(linear - 0.8, 0.0) * 0.6);
    vec3 dark = vec3(lessThan(bounded, vec3(0.0031308)));
    return mix(1.055 * pow(bounded, vec3(1.0 / 2.4)) - 0.055, bounded * 12.92, dark);
}`;

export const modelFragment = `${shared}${shade}
in vec3 at;
in vec3 out_of;
in vec4 hue;
in vec4 lit_at;
uniform vec3 light; // direction towards it
uniform vec3 back; // direction towards the eye
uniform float presence;
uniform vec2 heights; // of the drawing: its lowest point, and 1 / its height
out vec4 pixel;
void main() {
    if (presence < 1.0 && grain(gl_FragCoord.xy) >= presence) discard;
    vec3 normal = normalize(out_of) * (gl_FrontFacing ? 1.0 : -1.0);
    float facing = dot(normal, light);
    float sun = sunshine(lit_at, 0.0012);
    float height = clamp((at.y - heights.x) * heights.y, 0.0, 1.0);
    vec3 sky = mix(vec3(0.30, 0.27, 0.25), vec3(0.46, 0.49, 0.55), normal.y * 0.5 + 0.5) * mix(0.72, 1.0, height);
    vec3 direct = vec3(1.02, 0.96, 0.86) * max(facing, 0.0) * sun;
    float leaf = step(0.5, hue.a); // leaves are translucent
    vec3 through = vec3(0.55, 0.6, 0.3) * leaf * max(-facing, 0.0) * mix(0.35, 1.0, sun);
    float rim = pow(1.0 - max(dot(normal, back), 0.0), 3.0) * 0.10;
    vec3 sheen = vec3(pow(max(dot(normal, normalize(light + back)), 0.0), 28.0)) * 0.06 * sun;
    pixel = vec4(shown(hue.rgb * (sky + direct + through + rim) + sheen), 1.0);
}`;

export const shadowVertex = `${shared}
layout(location = 0) in vec3 position;
uniform mat4 sun;
void main() { gl_Position = sun * vec4(position, 1.0); }`;

export const shadowFragment = `${shared}
void main() {}`;

export const groundVertex = `${shared}
layout(location = 0) in vec2 corner;
uniform mat4 eye;
uniform mat4 sun;
uniform vec3 middle;
uniform float reach;
out vec4 lit_at;
out vec2 away;
void main() {
    vec3 at = middle + vec3(corner.x, 0.0, corner.y) * reach;
    away = corner;
    lit_at = sun * vec4(at, 1.0);
    gl_Position = eye * vec4(at, 1.0);
}`;

// The lit ground below the drawing, with its shadow.
export const groundFragment = `${shared}${shade}
in vec4 lit_at;
in vec2 away;
uniform vec4 soil; // premultiplied
uniform float strength; // of shadows
uniform float presence;
out vec4 pixel;
void main() {
    float fade = 1.0 - smoothstep(0.25, 1.0, length(away));
    float dark = (1.0 - sunshine(lit_at, 0.0008)) * strength * fade;
    vec4 pool = soil * fade * fade;
    vec3 shadow = vec3(0.20, 0.12, 0.07);
    pixel = vec4(mix(pool.rgb, shadow, dark), pool.a + (1.0 - pool.a) * dark) * presence;
}`;
