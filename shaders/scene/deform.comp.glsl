// Bends one primitive of one instance: morph targets, then joints (engine/scene/deformation.hpp has the formula). What
// is written are the vertices that all techniques draw; their other attributes are there already.
#include "shared/deform_types.h"

layout(local_size_x = kDeformGroup) in;

// Vertices, `stride` floats each: position, normal, tangent, then what is no concern here.
layout(std430, binding = 0) readonly buffer Rest { float rest[]; };
layout(std430, binding = 1) writeonly buffer Posed { float posed[]; };
layout(std430, binding = 2) readonly buffer Influences { InfluenceData influences[]; };
// By target and vertex `deltaWidth` floats: position, with 6 or 9 normal, with 9 tangent.
layout(std430, binding = 3) readonly buffer Deltas { float deltas[]; };
layout(std430, binding = 4) readonly buffer Joints { mat4 originFromMesh[]; };
layout(std430, binding = 5) readonly buffer Active { ActiveTarget activeTargets[]; };

uniform int vertexCount, stride;
uniform int perVertex;                // influences, 0: no skin
uniform int firstJoint;
uniform int firstActive, activeCount, deltaWidth;
uniform int flatNormals;              // 1: of the triangle of each three vertices

struct Bent {
    vec3 position, normal, tangent;
    float handedness;
};

vec3 restAt(int at) {
    return vec3(rest[at], rest[at + 1], rest[at + 2]);
}
vec3 deltaAt(int at) {
    return vec3(deltas[at], deltas[at + 1], deltas[at + 2]);
}

Bent bent(int vertex) {
    int at = vertex * stride;
    Bent b = Bent(restAt(at), restAt(at + 3), restAt(at + 6), rest[at + 9]);
    for (int i = firstActive; i < firstActive + activeCount; ++i) {
        int delta = (int(activeTargets[i].target) * vertexCount + vertex) * deltaWidth;
        float weight = activeTargets[i].weight;
        b.position += weight * deltaAt(delta);
        if (deltaWidth >= 6) b.normal += weight * deltaAt(delta + 3);
        if (deltaWidth >= 9) b.tangent += weight * deltaAt(delta + 6);
    }
    if (perVertex > 0) {
        mat4 m = mat4(0.0);
        for (int i = vertex * perVertex; i < (vertex + 1) * perVertex; ++i)
            m += influences[i].weight * originFromMesh[firstJoint + int(influences[i].joint)];
        mat3 linear = mat3(m);
        float side = sign(determinant(linear));
        b.position = linear * b.position + m[3].xyz;
        // Cofactors: right for any scale, its sign included.
        b.normal = side * mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1])) *
                   b.normal;
        b.tangent = linear * b.tangent;
        b.handedness *= side;
    }
    return b;
}

vec3 unitOr(vec3 v, vec3 otherwise) {
    float square = dot(v, v);
    return square > 0.0 && square < 3.0e38 ? v * inversesqrt(square) : otherwise;
}

void write(int at, vec3 v) {
    posed[at] = v.x;
    posed[at + 1] = v.y;
    posed[at + 2] = v.z;
}

void main() {
    int step = int(gl_NumWorkGroups.x) * kDeformGroup;
    for (int vertex = int(gl_GlobalInvocationID.x); vertex < vertexCount; vertex += step) {
        Bent b = bent(vertex);
        if (flatNormals != 0) {
            int first = vertex / 3 * 3;
            vec3 corner = bent(first).position;
            vec3 face = cross(bent(first + 1).position - corner, bent(first + 2).position - corner);
            // Mirrored triangles run the other way round.
            b.normal = (b.handedness * rest[vertex * stride + 9] < 0.0 ? -1.0 : 1.0) * face;
        }
        int at = vertex * stride;
        write(at, b.position);
        write(at + 3, unitOr(b.normal, vec3(0.0, 0.0, 1.0)));
        write(at + 6, unitOr(b.tangent, vec3(0.0)));
        posed[at + 9] = b.handedness;
    }
}
