// Raylib's software renderer rlsw, timed for `cargo xtask peers`: the scene of a file, by indices into vertex arrays,
// into its own framebuffer.
//
//     cc -O3 -march=native -DRLSW_USE_SIMD_INTRINSICS rlsw.c -idirafter RAYLIB/src/external -o rlsw -lm
//     ./rlsw SCENE WIDTH HEIGHT
//
// What it takes and answers is in `peer.h`. The header is used as it is, version 1.5 when this was written:
//
// * Colour is RGBA of 8 bits and depth is `float`, its defaults. It blends nothing, and textures are not tinted.
// * RLSW_USE_SIMD_INTRINSICS is its documented option. It looks at the compiler's target, not at the machine, so it is
//   built for this one.
// * Its intrinsics for SSE4.1 are off where the compiler has SSE4.2 or AVX too, so SW_HAS_SSE41 is defined here. Of
//   the builds that were tried this is the fastest. Fills and floors take 0.9 of the time of a build for SSE4.1, 0.65
//   of one for AVX2 without intrinsics, and 0.5 of one for neither.
// * Immediate mode, arrays and indices are equally fast, within what runs of one differ by.
// * Vertices have places and texture coordinates in `float`, but colours in bytes.
// * It has neither mip maps nor shaders.
#define PEER "rlsw"
#include "peer.h"

#if defined(RLSW_USE_SIMD_INTRINSICS) && defined(__SSE4_1__)
#define SW_HAS_SSE41
#endif
#define SW_FRAMEBUFFER_COLOR_TYPE R8G8B8A8
#define SW_FRAMEBUFFER_DEPTH_TYPE D32
#define SW_FRAMEBUFFER_OUTPUT_BGRA false
#define RLSW_IMPLEMENTATION
#include <rlsw.h>

// Whole repeats of the texture, after which no coordinate is below 1, and the picture is the same. Below half a texel
// rlsw rounds the wrong way in its bilinear filter, and below zero its nearest texel may be beyond the texture.
static float repeats(const struct scene *scene, int axis) {
    float least = 1;
    for (uint32_t i = 0; i < scene->vertices; i++) {
        if (scene->vertex[i].uv[axis] < least) least = scene->vertex[i].uv[axis];
    }
    return 1 - floorf(least);
}

static void bind_uvs(const struct scene *scene) {
    float *uvs = memory(2 * sizeof *uvs, scene->vertices);
    for (int axis = 0; axis < 2; axis++) {
        float more = repeats(scene, axis);
        for (size_t i = 0; i < scene->vertices; i++) uvs[2 * i + axis] = scene->vertex[i].uv[axis] + more;
    }
    swBindArray(SW_TEXTURE_COORD_ARRAY, uvs);
}

static void bind_texture(const struct scene *scene) {
    uint32_t texture = 0;
    swGenTextures(1, &texture);
    swBindTexture(texture);
    swTexImage2D(scene->columns, scene->rows, SW_RGBA, SW_UNSIGNED_BYTE, scene->texels);
    int filter = scene->filter == NEAREST ? SW_NEAREST : SW_LINEAR;
    swTexParameteri(SW_TEXTURE_MIN_FILTER, filter);
    swTexParameteri(SW_TEXTURE_MAG_FILTER, filter);
    swTexParameteri(SW_TEXTURE_WRAP_S, SW_REPEAT);
    swTexParameteri(SW_TEXTURE_WRAP_T, SW_REPEAT);
    swEnable(SW_TEXTURE_2D);
}

static void bind_colors(const struct scene *scene) {
    unsigned char *colors = memory(4, scene->vertices);
    for (size_t i = 0; i < scene->vertices; i++) {
        const float *color = scene->vertex[i].color;
        for (int k = 0; k < 3; k++) colors[4 * i + k] = (unsigned char)(color[k] * 255 + 0.5f);
        colors[4 * i + 3] = 255;
    }
    swBindArray(SW_COLOR_ARRAY, colors);
}

static const char *prepare(const struct scene *scene) {
    if (scene->lit) return "shaders";
    if (scene->filter == TRILINEAR) return "mip maps";
    if (!swInit(scene->width, scene->height)) fail("no memory");
    swEnable(SW_DEPTH_TEST);
    swEnable(SW_CULL_FACE);
    const float *color = scene->background;
    swClearColor(color[0], color[1], color[2], color[3]);

    float columns[16];
    for (int i = 0; i < 16; i++) columns[i] = scene->matrix[i % 4 * 4 + i / 4];
    swMatrixMode(SW_PROJECTION);
    swLoadIdentity();
    swMultMatrixf(columns);

    float *places = memory(3 * sizeof *places, scene->vertices);
    for (size_t i = 0; i < scene->vertices; i++) memcpy(places + 3 * i, scene->vertex[i].place, 3 * sizeof *places);
    swBindArray(SW_VERTEX_ARRAY, places);
    if (scene->columns) {
        bind_uvs(scene);
        bind_texture(scene);
    } else {
        bind_colors(scene);
    }
    if (swGetError() != SW_NO_ERROR) fail("rlsw does not take this scene");
    return NULL;
}

static const char *name(void) {
    static char text[256];
    snprintf(text, sizeof text, "%s, %s", swGetString(SW_RENDERER), swGetString(SW_VERSION));
    return text;
}

static void draw(const struct scene *scene) {
    swClear(SW_COLOR_BUFFER_BIT | SW_DEPTH_BUFFER_BIT);
    swDrawElements(SW_TRIANGLES, scene->corners, SW_UNSIGNED_INT, scene->corner);
}

static void read_picture(const struct scene *scene, unsigned char *pixels) {
    swReadPixels(0, 0, scene->width, scene->height, SW_RGBA, SW_UNSIGNED_BYTE, pixels);
}
