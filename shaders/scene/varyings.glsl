// What the vertex stage tells the fragment stage; STAGE is out in the one, in in the other.
STAGE Surface {
    vec3 viewPosition;
    vec3 normal;
    vec4 tangent;
    vec2 uv;
#ifdef EXTRAS
    vec2 uv1;
    vec4 color;
#endif
} surface;
flat STAGE uint material;
