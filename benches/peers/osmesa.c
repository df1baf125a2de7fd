// Mesa's llvmpipe by OSMesa, timed for `cargo xtask peers`: the scene of a file, drawn from buffers of the GL into a
// framebuffer object, without a window.
//
//     cc -O3 osmesa.c -o osmesa -lOSMesa
//     LP_NUM_THREADS=0 ./osmesa SCENE WIDTH HEIGHT
//
// LP_NUM_THREADS=0 draws in the thread that calls. The rest of what it takes and answers is in `peer.h`.
#define GL_GLEXT_PROTOTYPES
#define PEER "osmesa"
#include "peer.h"
#include <GL/osmesa.h>
#include <GL/glext.h>

// A level of detail of a texture after the other, into the texture that is bound.
static void upload(uint32_t columns, uint32_t rows, uint32_t levels, const unsigned char *texels) {
    for (uint32_t level = 0; level < levels; level++) {
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, columns, rows, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
        texels += 4 * (size_t)columns * rows;
        columns = half(columns);
        rows = half(rows);
    }
}

static void filter_by(uint32_t filter, uint32_t probes) {
    const GLint smaller[] = {[NEAREST] = GL_NEAREST, [BILINEAR] = GL_LINEAR, [TRILINEAR] = GL_LINEAR_MIPMAP_LINEAR};
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smaller[filter]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter == NEAREST ? GL_NEAREST : GL_LINEAR);
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

// The normal map, the light, and the vertices' frames.
static void light_up(const struct scene *scene) {
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
    glUniform3fv(glGetUniformLocation(program, "to_light"), 1, scene->light);
    glUniform1f(glGetUniformLocation(program, "light"), scene->light[3]);
    glUniform1f(glGetUniformLocation(program, "ambient"), scene->light[4]);

    glActiveTexture(GL_TEXTURE1);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    upload(scene->columns, scene->rows, scene->levels, scene->normals);
    filter_by(scene->filter, 1);

    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    const float *none = NULL;
    glBufferData(GL_ARRAY_BUFFER, 7 * sizeof *none * scene->vertices, scene->axes, GL_STATIC_DRAW);
    glEnableVertexAttribArray(6);
    glVertexAttribPointer(6, 3, GL_FLOAT, GL_FALSE, 7 * sizeof *none, none);
    glEnableVertexAttribArray(7);
    glVertexAttribPointer(7, 4, GL_FLOAT, GL_FALSE, 7 * sizeof *none, none + 3);
}

static const char *prepare(const struct scene *scene) {
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, NULL);
    static unsigned char window[4 * 16 * 16];
    if (!context || !OSMesaMakeCurrent(context, window, GL_UNSIGNED_BYTE, 16, 16)) fail("there is no context");

    GLuint frame, targets[2], buffers[2];
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glGenRenderbuffers(2, targets);
    const GLenum formats[2] = {GL_RGBA8, GL_DEPTH_COMPONENT32F};
    const GLenum places[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    for (int i = 0; i < 2; i++) {
        glBindRenderbuffer(GL_RENDERBUFFER, targets[i]);
        glRenderbufferStorage(GL_RENDERBUFFER, formats[i], scene->width, scene->height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, targets[i]);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) fail("the framebuffer is incomplete");
    glViewport(0, 0, scene->width, scene->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    const float *color = scene->background;
    glClearColor(color[0], color[1], color[2], color[3]);

    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, scene->vertices * sizeof *scene->vertex, scene->vertex, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, scene->corners * sizeof *scene->corner, scene->corner, GL_STATIC_DRAW);
    const struct vertex *none = NULL;
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof *none, none->place);
    if (scene->columns) {
        glEnableClientState(GL_TEXTURE_COORD_ARRAY);
        glTexCoordPointer(2, GL_FLOAT, sizeof *none, none->uv);
    } else {
        glEnableClientState(GL_COLOR_ARRAY);
        glColorPointer(3, GL_FLOAT, sizeof *none, none->color);
    }
    glMatrixMode(GL_PROJECTION);
    glLoadTransposeMatrixf(scene->matrix);

    if (scene->columns) {
        GLuint texture;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glEnable(GL_TEXTURE_2D);
        glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
        upload(scene->columns, scene->rows, scene->levels, scene->texels);
        filter_by(scene->filter, scene->probes);
    }
    if (scene->lit) light_up(scene);
    if (glGetError() != GL_NO_ERROR) fail("the GL does not take this scene");
    return NULL;
}

static const char *name(void) {
    static char text[256];
    snprintf(text, sizeof text, "%s, %s", glGetString(GL_RENDERER), glGetString(GL_VERSION));
    return text;
}

static void draw(const struct scene *scene) {
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawElements(GL_TRIANGLES, scene->corners, GL_UNSIGNED_INT, NULL);
    glFinish();
}

static void read_picture(const struct scene *scene, unsigned char *pixels) {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    // Rows of the GL begin at the bottom.
    for (int y = scene->height; y--; pixels += 4 * (size_t)scene->width) {
        glReadPixels(0, y, scene->width, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    }
}
