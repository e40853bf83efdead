// Two eyes' linear radiance to one picture. One program for each way: on a software renderer, which runs both sides of an
// `if`, one for all took ten times as long.
//   MONO, SIDE_BY_SIDE, SIDE_BY_SIDE_HALF, TOP_BOTTOM, ANAGLYPH: one of them
//   NEUTRAL  Khronos PBR Neutral tone mapping
//   ENCODE   to sRGB, for a window
//   SMALLER  the eyes' pictures have fewer pixels than are shown of them
#include "present/srgb.glsl"

layout(binding = 0) uniform sampler2D leftEye;
layout(binding = 1) uniform sampler2D rightEye;
uniform vec2 origin;   // of the picture in the target, pixels
uniform vec2 size;     // of the picture in the target, pixels
uniform vec2 eyeSize;  // of one eye's picture as it is shown, pixels

layout(location = 0) out vec4 color;

// At a place in the eye's pixels; filtered where it is stretched.
vec3 eye(sampler2D picture, vec2 at) {
#if defined(ENCODE) || defined(SMALLER)
    return textureLod(picture, at / eyeSize, 0.0).rgb;
#else
    return texelFetch(picture, ivec2(at), 0).rgb;
#endif
}

// Squeezed to half width: two source pixels to one, so that nothing is skipped.
vec3 squeezed(sampler2D picture, vec2 at) {
#ifdef SMALLER
    return eye(picture, vec2(2.0 * floor(at.x) + 1.0, at.y));
#endif
    int x = 2 * int(at.x), last = textureSize(picture, 0).x - 1;
    ivec2 first = ivec2(min(x, last), at.y), second = ivec2(min(x + 1, last), at.y);
    return 0.5 * (texelFetch(picture, first, 0).rgb + texelFetch(picture, second, 0).rgb);
}

// Dubois 2001, "A projection method to generate anaglyph stereo images": least squares for red-cyan glasses, linear RGB.
vec3 anaglyph(vec3 l, vec3 r) {
    const mat3 kLeft = mat3(0.4561, -0.0400822, -0.0152161, 0.500484, -0.0378246, -0.0205971, 0.176381, -0.0157589,
                            -0.00546856);
    const mat3 kRight = mat3(-0.0434706, 0.378476, -0.0721527, -0.0879388, 0.73364, -0.112961, -0.00155529, -0.0184503,
                             1.2264);
    // The display's range is part of the derivation.
    return max(kLeft * min(l, 1.0) + kRight * min(r, 1.0), 0.0);
}

// Khronos PBR Neutral: colours stay as they are below 0.8, highlights roll off and lose saturation.
vec3 toneMapNeutral(vec3 c) {
    const float kStart = 0.8 - 0.04;
    const float kDesaturation = 0.15;
    float x = min(c.r, min(c.g, c.b));
    c -= x < 0.08 ? x - 6.25 * x * x : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < kStart) return c;
    float d = 1.0 - kStart;
    float newPeak = 1.0 - d * d / (peak + d - kStart);
    c *= newPeak / peak;
    return mix(c, vec3(newPeak), 1.0 - 1.0 / (kDesaturation * (peak - newPeak) + 1.0));
}

void main() {
    vec2 at = gl_FragCoord.xy - origin;
#ifdef MONO
    vec3 c = eye(leftEye, at * (eyeSize / size));
#elif defined(ANAGLYPH)
    vec3 c = anaglyph(eye(leftEye, at), eye(rightEye, at));
#else
    // Both eyes' halves begin at a whole pixel, so that equal pictures stay equal to the bit; the left eye is above.
    vec2 halves = ceil(0.5 * size);
#ifdef TOP_BOTTOM
    bool second = at.y < halves.y;
    if (!second) at.y -= halves.y;
#else
    bool second = at.x >= halves.x;
    if (second) at.x -= halves.x;
#endif
#ifdef SIDE_BY_SIDE_HALF
    vec3 c = second ? squeezed(rightEye, at) : squeezed(leftEye, at);
#else
    vec3 c = second ? eye(rightEye, at) : eye(leftEye, at);
#endif
#endif
#ifdef NEUTRAL
    c = toneMapNeutral(c);
#endif
#ifdef ENCODE
    c = sRgb(c);
#endif
    color = vec4(c, 1.0);
}
