// The one place that brings in OpenGL: a generated 4.5 core loader.
#pragma once

#include <glad/gl.h>
