// What the vertex stage tells the fragment stage; STAGE is out in the one, in in the other.
STAGE Surface {
    vec3 viewPosition;
    vec3 normal;
    vec4 tangent;
#ifdef MAPPED
    vec2 uv[kMaterialTextures];  // where each texture is read
#else
    vec2 uv;
#endif
#ifdef EXTRAS
    vec4 color;
#endif
} surface;
