// Mesa's llvmpipe by OSMesa, timed for `cargo xtask peers`: the scene of a file, drawn from buffers of the GL into a
// framebuffer object, without a window.
//
//     cc -O3 osmesa.c -o osmesa -lOSMesa
//     LP_NUM_THREADS=0 ./osmesa SCENE WIDTH HEIGHT
//
// LP_NUM_THREADS=0 draws in the thread that calls. The scene's format is that of `benches/src/peers.rs`. On standard
// input it takes a line `name` or `frames N`, and answers with a line, the N frames' least milliseconds; or a line
// `picture FILE`, which it answers when the file is written: R, G, B, A, rows from the top.
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
#include <GL/glext.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static FILE *scene;

static void fail(const char *message) {
    fprintf(stderr, "osmesa: %s\n", message);
    exit(2);
}

static void take(void *to, size_t size, size_t count) {
    if (fread(to, size, count, scene) != count) fail("the scene's file is too short");
}

static uint32_t word(void) {
    uint32_t x;
    take(&x, sizeof x, 1);
    return x;
}

static void *array(size_t size, size_t count) {
    void *values = malloc(size * count + 1);
    if (!values) fail("no memory");
    take(values, size, count);
    return values;
}

static double milliseconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * t.tv_sec + 1e-6 * t.tv_nsec;
}

// A vertex as it lies in the buffer: place, texture coordinates from the top left corner, colour.
struct vertex {
    float place[3], uv[2], color[3];
};

int main(int count, char **arguments) {
    if (count != 4) fail("expected a scene, a width and a height");
    scene = fopen(arguments[1], "rb");
    if (!scene) fail("the scene cannot be opened");
    int width = atoi(arguments[2]), height = atoi(arguments[3]);
    if (width < 1 || height < 1) fail("expected a width and a height");

    float matrix[16], background[4];
    take(matrix, sizeof matrix, 1);
    take(background, sizeof background, 1);
    uint32_t filter = word(), probes = word();
    if (filter > 2) fail("no such filter");
    uint32_t vertices = word();
    struct vertex *vertex = array(sizeof *vertex, vertices);
    uint32_t triangles = word();
    uint32_t *triangle = array(3 * sizeof *triangle, triangles);
    uint32_t columns = word(), rows = word();
    unsigned char *texels = array(4, (size_t)columns * rows);

    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, NULL);
    unsigned char window[4 * 16 * 16];
    if (!context || !OSMesaMakeCurrent(context, window, GL_UNSIGNED_BYTE, 16, 16)) fail("there is no context");

    GLuint frame, targets[2], buffers[2];
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glGenRenderbuffers(2, targets);
    const GLenum formats[2] = {GL_RGBA8, GL_DEPTH_COMPONENT32F};
    const GLenum places[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    for (int i = 0; i < 2; i++) {
        glBindRenderbuffer(GL_RENDERBUFFER, targets[i]);
        glRenderbufferStorage(GL_RENDERBUFFER, formats[i], width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, targets[i]);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) fail("the framebuffer is incomplete");
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glClearColor(background[0], background[1], background[2], background[3]);

    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, vertices * sizeof *vertex, vertex, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, 12 * (size_t)triangles, triangle, GL_STATIC_DRAW);
    const struct vertex *none = NULL;
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof *none, none->place);
    if (columns) {
        glEnableClientState(GL_TEXTURE_COORD_ARRAY);
        glTexCoordPointer(2, GL_FLOAT, sizeof *none, none->uv);
    } else {
        glEnableClientState(GL_COLOR_ARRAY);
        glColorPointer(3, GL_FLOAT, sizeof *none, none->color);
    }
    glMatrixMode(GL_PROJECTION);
    glLoadTransposeMatrixf(matrix);

    if (columns) {
        GLuint texture;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glEnable(GL_TEXTURE_2D);
        glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, columns, rows, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
        const GLint smaller[3] = {GL_NEAREST, GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR};
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smaller[filter]);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter ? GL_LINEAR : GL_NEAREST);
        if (filter == 2) glGenerateMipmap(GL_TEXTURE_2D);
        if (probes > 1) glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY, probes);
    }
    if (glGetError() != GL_NO_ERROR) fail("the GL does not take this scene");

    char line[4096];
    while (fgets(line, sizeof line, stdin)) {
        line[strcspn(line, "\n")] = 0;
        int frames;
        if (!strcmp(line, "name")) {
            printf("%s, %s\n", glGetString(GL_RENDERER), glGetString(GL_VERSION));
        } else if (sscanf(line, "frames %d", &frames) == 1) {
            double least = 1e30;
            for (int i = 0; i < frames; i++) {
                double start = milliseconds();
                glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
                glDrawElements(GL_TRIANGLES, 3 * triangles, GL_UNSIGNED_INT, NULL);
                glFinish();
                double time = milliseconds() - start;
                if (time < least) least = time;
            }
            printf("%.6f\n", least);
        } else if (!strncmp(line, "picture ", 8)) {
            unsigned char *pixels = malloc(4 * (size_t)width * height);
            FILE *file = fopen(line + 8, "wb");
            if (!pixels || !file) fail("the picture cannot be written");
            glPixelStorei(GL_PACK_ALIGNMENT, 1);
            glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
            for (int y = height; y--;) {
                if (fwrite(pixels + 4 * (size_t)width * y, 4, width, file) != (size_t)width) fail("the picture is cut");
            }
            if (fclose(file)) fail("the picture is cut");
            free(pixels);
            printf("written\n");
        } else {
            fail("expected `name`, `frames N` or `picture FILE`");
        }
        fflush(stdout);
    }
    return 0;
}
