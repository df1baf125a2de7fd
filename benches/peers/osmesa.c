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

// A level of detail of a texture after the other, into the texture that is bound.
static void upload(uint32_t columns, uint32_t rows, uint32_t levels, const unsigned char *texels) {
    for (uint32_t level = 0; level < levels; level++) {
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, columns, rows, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
        texels += 4 * (size_t)columns * rows;
        columns = columns > 1 ? columns / 2 : 1;
        rows = rows > 1 ? rows / 2 : 1;
    }
}

static size_t texel_count(uint32_t columns, uint32_t rows, uint32_t levels) {
    size_t sum = 0;
    while (levels--) {
        sum += (size_t)columns * rows;
        columns = columns > 1 ? columns / 2 : 1;
        rows = rows > 1 ? rows / 2 : 1;
    }
    return sum;
}

static void filter_by(uint32_t filter, uint32_t probes) {
    const GLint smaller[3] = {GL_NEAREST, GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR};
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smaller[filter]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter ? GL_LINEAR : GL_NEAREST);
    if (probes > 1) glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY, probes);
}

// The surface with a normal map: its frame from vertex to vertex, a light at infinity, Lambert's law.
static const char *const vertex_stage =
    "#version 120\n"
    "attribute vec3 normal;\n"
    "attribute vec4 tangent;\n"
    "varying vec2 uv;\n"
    "varying vec3 t, b, m;\n"
    "void main() {\n"
    "    gl_Position = gl_ProjectionMatrix * gl_Vertex;\n"
    "    uv = gl_MultiTexCoord0.xy;\n"
    "    t = tangent.xyz;\n"
    "    b = cross(normal, tangent.xyz) * tangent.w;\n"
    "    m = normal;\n"
    "}\n";
static const char *const fragment_stage =
    "#version 120\n"
    "uniform sampler2D colors, normals;\n"
    "uniform vec3 to_light;\n"
    "uniform float light, ambient;\n"
    "varying vec2 uv;\n"
    "varying vec3 t, b, m;\n"
    "void main() {\n"
    "    vec3 map = texture2D(normals, uv).xyz * 2.0 - 1.0;\n"
    "    vec3 n = normalize(t * map.x + b * map.y + m * map.z);\n"
    "    vec3 color = texture2D(colors, uv).rgb;\n"
    "    gl_FragColor = vec4(color * (ambient + light * max(dot(n, to_light), 0.0)), 1.0);\n"
    "}\n";

static void compile(GLuint program, GLenum kind, const char *source) {
    GLuint stage = glCreateShader(kind);
    glShaderSource(stage, 1, &source, NULL);
    glCompileShader(stage);
    glAttachShader(program, stage);
}

// The rest of the scene's file: the normal map, the light, and the vertices' frames.
static void light_up(uint32_t vertices, uint32_t columns, uint32_t rows, uint32_t levels, uint32_t filter) {
    unsigned char *texels = array(4, texel_count(columns, rows, levels));
    float light[5];
    take(light, sizeof light, 1);
    float *axes = array(7 * sizeof *axes, vertices);

    GLuint program = glCreateProgram(), texture, buffer;
    compile(program, GL_VERTEX_SHADER, vertex_stage);
    compile(program, GL_FRAGMENT_SHADER, fragment_stage);
    glBindAttribLocation(program, 6, "normal");
    glBindAttribLocation(program, 7, "tangent");
    glLinkProgram(program);
    GLint linked;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) fail("the GL does not compile the stages");
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "colors"), 0);
    glUniform1i(glGetUniformLocation(program, "normals"), 1);
    glUniform3fv(glGetUniformLocation(program, "to_light"), 1, light);
    glUniform1f(glGetUniformLocation(program, "light"), light[3]);
    glUniform1f(glGetUniformLocation(program, "ambient"), light[4]);

    glActiveTexture(GL_TEXTURE1);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    upload(columns, rows, levels, texels);
    filter_by(filter, 1);

    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, 7 * sizeof *axes * vertices, axes, GL_STATIC_DRAW);
    const float *none = NULL;
    glEnableVertexAttribArray(6);
    glVertexAttribPointer(6, 3, GL_FLOAT, GL_FALSE, 7 * sizeof *none, none);
    glEnableVertexAttribArray(7);
    glVertexAttribPointer(7, 4, GL_FLOAT, GL_FALSE, 7 * sizeof *none, none + 3);
}

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
    uint32_t columns = word(), rows = word(), levels = word();
    unsigned char *texels = array(4, texel_count(columns, rows, levels));

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
        upload(columns, rows, levels, texels);
        filter_by(filter, probes);
    }
    if (word()) light_up(vertices, columns, rows, levels, filter);
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
