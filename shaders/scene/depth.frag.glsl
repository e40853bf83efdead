// Depth only; with MASK, texels below the cut-off are not there.
#ifdef MASK
#include "scene/base_color.glsl"

void main() { baseColorOf(); }
#else
void main() {}
#endif
