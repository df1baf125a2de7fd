// The part that peers in C have in common: the scene of a file, the requests of `cargo xtask peers`, and the clock.
//
//     ./peer SCENE WIDTH HEIGHT
//
// The scene's format is that of `benches/src/peers.rs`. On standard input it takes a line `name`, which it answers by
// its name, or by `lacks` and the feature without which it cannot draw the scene. To a line `frames N` the answer is
// the N frames' least milliseconds. It answers a line `picture FILE` when the file is written: R, G, B, A, rows from
// the top. What a library prints goes to standard error.
#ifndef PEER_H
#define PEER_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

// A vertex as it lies in the file: place, texture coordinates from the top left corner, colour.
struct vertex {
    float place[3], uv[2], color[3];
};

enum { NEAREST, BILINEAR, TRILINEAR };

struct scene {
    int width, height;
    // From world to clip space, row by row.
    float matrix[16];
    float background[4];
    uint32_t filter, probes;
    uint32_t vertices;
    struct vertex *vertex;
    // Corners, three of each triangle.
    uint32_t corners, *corner;
    // The texture, one level of detail after the other; no columns where there is none.
    uint32_t columns, rows, levels;
    unsigned char *texels;
    // A normal map of the same size, the direction to the light, light and ambient light, and the vertices' frames.
    uint32_t lit;
    unsigned char *normals;
    float light[5], *axes;
};

// Functions of the peer. `prepare` does what is not timed, and returns what the peer lacks for the scene, or NULL.
static const char *prepare(const struct scene *scene);
static const char *name(void);
static void draw(const struct scene *scene);
static void read_picture(const struct scene *scene, unsigned char *pixels);

static void fail(const char *message) {
    fprintf(stderr, PEER ": %s\n", message);
    exit(2);
}

static void *memory(size_t size, size_t count) {
    void *values = malloc(size * count + 1);
    if (!values) fail("no memory");
    return values;
}

static void take(FILE *file, void *to, size_t size, size_t count) {
    if (fread(to, size, count, file) != count) fail("the scene's file is too short");
}

static uint32_t take_word(FILE *file) {
    uint32_t x;
    take(file, &x, sizeof x, 1);
    return x;
}

static void *take_array(FILE *file, size_t size, size_t count) {
    void *values = memory(size, count);
    take(file, values, size, count);
    return values;
}

static uint32_t half(uint32_t side) {
    return side > 1 ? side / 2 : 1;
}

static size_t texel_count(uint32_t columns, uint32_t rows, uint32_t levels) {
    size_t sum = 0;
    while (levels--) {
        sum += (size_t)columns * rows;
        columns = half(columns);
        rows = half(rows);
    }
    return sum;
}

static void read_scene(struct scene *scene, const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) fail("the scene cannot be opened");
    take(file, scene->matrix, sizeof scene->matrix, 1);
    take(file, scene->background, sizeof scene->background, 1);
    scene->filter = take_word(file);
    scene->probes = take_word(file);
    if (scene->filter > TRILINEAR) fail("no such filter");
    scene->vertices = take_word(file);
    scene->vertex = take_array(file, sizeof *scene->vertex, scene->vertices);
    scene->corners = 3 * take_word(file);
    scene->corner = take_array(file, sizeof *scene->corner, scene->corners);
    scene->columns = take_word(file);
    scene->rows = take_word(file);
    scene->levels = take_word(file);
    size_t texels = texel_count(scene->columns, scene->rows, scene->levels);
    scene->texels = take_array(file, 4, texels);
    scene->lit = take_word(file);
    if (scene->lit) {
        scene->normals = take_array(file, 4, texels);
        take(file, scene->light, sizeof scene->light, 1);
        scene->axes = take_array(file, 7 * sizeof *scene->axes, scene->vertices);
    }
    fclose(file);
}

static double milliseconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * t.tv_sec + 1e-6 * t.tv_nsec;
}

static double least_milliseconds(const struct scene *scene, int frames) {
    double least = 1e30;
    for (int i = 0; i < frames; i++) {
        double start = milliseconds();
        draw(scene);
        double time = milliseconds() - start;
        if (time < least) least = time;
    }
    return least;
}

static void write_picture(const struct scene *scene, const char *path) {
    size_t count = (size_t)scene->width * scene->height;
    unsigned char *pixels = memory(4, count);
    FILE *file = fopen(path, "wb");
    if (!file) fail("the picture cannot be written");
    read_picture(scene, pixels);
    if (fwrite(pixels, 4, count, file) != count || fclose(file)) fail("the picture is cut");
    free(pixels);
}

int main(int count, char **arguments) {
    if (count != 4) fail("expected a scene, a width and a height");
    FILE *answers = fdopen(dup(STDOUT_FILENO), "w");
    if (!answers || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) fail("there is no standard output");
    struct scene scene = {.width = atoi(arguments[2]), .height = atoi(arguments[3])};
    if (scene.width < 1 || scene.height < 1) fail("expected a width and a height");
    read_scene(&scene, arguments[1]);
    const char *lacks = prepare(&scene);

    char line[4096];
    while (fgets(line, sizeof line, stdin)) {
        line[strcspn(line, "\n")] = 0;
        int frames;
        if (!strcmp(line, "name")) {
            fprintf(answers, "%s%s\n", lacks ? "lacks " : "", lacks ? lacks : name());
        } else if (lacks) {
            fail("cannot draw this scene");
        } else if (sscanf(line, "frames %d", &frames) == 1) {
            fprintf(answers, "%.6f\n", least_milliseconds(&scene, frames));
        } else if (!strncmp(line, "picture ", 8)) {
            write_picture(&scene, line + 8);
            fprintf(answers, "written\n");
        } else {
            fail("expected `name`, `frames N` or `picture FILE`");
        }
        fflush(answers);
    }
    return 0;
}

#endif
