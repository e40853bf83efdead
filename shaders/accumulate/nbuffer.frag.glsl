// N-buffer, Decoret 2005: bounds of squares of 2 * side tiles a side, from those of `side`. A square begins at its own
// tile; beyond the picture the last tile goes on.
layout(binding = 0) uniform sampler2DArray finer;
uniform int side;

layout(location = 0) out vec2 bounds;

void main() {
    ivec2 tile = ivec2(gl_FragCoord.xy), last = textureSize(finer, 0).xy - 1;
    bounds = vec2(1e30, 0.0);
    for (int corner = 0; corner < 4; ++corner) {
        ivec2 at = min(tile + ivec2(corner & 1, corner >> 1) * side, last);
        vec2 b = texelFetch(finer, ivec3(at, gl_Layer), 0).rg;
        bounds = vec2(min(bounds.x, b.x), max(bounds.y, b.y));
    }
}
