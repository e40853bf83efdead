// First level: 2×2 pixels to one texel of each layer, colours premultiplied by what the pixel gives to it.
#include "mipmap/layers.glsl"
layout(binding = 0) uniform sampler2D color;
layout(binding = 1) uniform sampler2D depth;

layout(location = 0) out vec4 base;    // in and behind focus: rgb·w, w
#ifdef FRONT
layout(location = 1) out vec4 front;   // in front of focus: rgb·share, share
layout(location = 2) out vec4 back;    // the rest: rgb·(1−share), 1−share
layout(location = 3) out vec4 spread;  // x: largest radius of the foreground, px; y: its mean · share
#endif

void main() {
    ivec2 last = textureSize(color, 0) - 1;
    ivec2 corner = ivec2(gl_FragCoord.xy) * 2;
    base = vec4(0.0);
#ifdef FRONT
    front = vec4(0.0);
    back = vec4(0.0);
    spread = vec4(0.0);
#endif
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = min(corner + ivec2(i & 1, i >> 1), last);
        vec4 quarter = vec4(texelFetch(color, pixel, 0).rgb, 1.0) * 0.25;
        float c = cocRadius(texelFetch(depth, pixel, 0).r);
        base += quarter * (1.0 - frontShare(c)) * baseWeight(abs(c), baseLargest);
#ifdef FRONT
        float share = frontShare(c);
        front += quarter * share;
        back += quarter * (1.0 - share);
        float radius = clamp(-c, 0.0, kMostRadius);
        spread.x = max(spread.x, share > 0.0 ? radius : 0.0);
        spread.y += share * radius * 0.25;
#endif
    }
}
