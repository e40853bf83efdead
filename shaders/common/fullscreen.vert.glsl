// One triangle over the whole target; with LAYERED, instance i to layer i.
#ifdef LAYERED
#extension GL_ARB_shader_viewport_layer_array : require
#endif
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
#ifdef LAYERED
    gl_Layer = gl_InstanceID;
#endif
}
