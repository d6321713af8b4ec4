/*
 * The planes of the depth lab through Mesa's llvmpipe with depth buffers D16, D24 and D32F, beside ours: the same
 * corners, the same pixels counted, the same sweep for the smallest separation at which no pixel is wrong. Mesa gets
 * the corners as they are (a float holds them up to 256 m) and a matrix in float.
 *
 * It prints the table. Where there is no framebuffer with such a depth buffer it says so and skips. D32F is the usual
 * projection, not a reversed one: its near plane is at 0.
 */
#define GL_GLEXT_PROTOTYPES
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesa.h"

#include "depth_budget_terms.h"
#include "depth_planes_count.h"

#include <GL/glext.h>
#include <math.h>
#include <stdio.h>

enum { WIDTH = 120, HEIGHT = 90, FORMATS = 3 };

static const struct {
    const char *name;
    GLenum format;
    const struct ph_depth_format *ours; /* of as many bits */
} formats[FORMATS] = {{"D16", GL_DEPTH_COMPONENT16, PH_DEPTH_FIXED16},
                      {"D24", GL_DEPTH_COMPONENT24, PH_DEPTH_FIXED24},
                      {"D32F", GL_DEPTH_COMPONENT32F, PH_DEPTH_FLOAT24}};

static struct mesa gl;
static GLuint buffers[FORMATS]; /* framebuffers; 0: Mesa refuses this depth buffer */

static const struct depth_lab lab = {
    .near_z = FX_HALF, .far_z = FX_INT(100), .fov_deg = FX_INT(60), .width = WIDTH, .height = HEIGHT};

/* ---- Mesa draws ------------------------------------------------------------------------------------------- */

#define CALL(type, name) ((type)(void (*)(void))OSMesaGetProcAddress(name))

static GLuint open_buffer(GLenum depth)
{
    GLuint buffer, colour_and_depth[2];
    CALL(PFNGLGENFRAMEBUFFERSPROC, "glGenFramebuffers")(1, &buffer);
    CALL(PFNGLBINDFRAMEBUFFERPROC, "glBindFramebuffer")(GL_FRAMEBUFFER, buffer);
    CALL(PFNGLGENRENDERBUFFERSPROC, "glGenRenderbuffers")(2, colour_and_depth);
    for (int i = 0; i < 2; i++) {
        CALL(PFNGLBINDRENDERBUFFERPROC, "glBindRenderbuffer")(GL_RENDERBUFFER, colour_and_depth[i]);
        CALL(PFNGLRENDERBUFFERSTORAGEPROC, "glRenderbufferStorage")
        (GL_RENDERBUFFER, i == 0 ? GL_RGBA8 : depth, WIDTH, HEIGHT);
        CALL(PFNGLFRAMEBUFFERRENDERBUFFERPROC, "glFramebufferRenderbuffer")
        (GL_FRAMEBUFFER, i == 0 ? GL_COLOR_ATTACHMENT0 : GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, colour_and_depth[i]);
    }
    const GLenum status = CALL(PFNGLCHECKFRAMEBUFFERSTATUSPROC, "glCheckFramebufferStatus")(GL_FRAMEBUFFER);
    return status == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR ? buffer : 0;
}

static void corner(const struct planes_quad *quad, int right, int top)
{
    glVertex3d((quad->a.x + (right ? quad->ux : 0)) / 65536.0, (quad->a.y + (top ? quad->vy : 0)) / 65536.0,
               (quad->a.z + (top ? quad->vz : 0)) / 65536.0);
}

static void quad_in(const struct planes_quad *quad, uint8_t colour)
{
    glColor3ub(colour, 0, 0);
    corner(quad, 0, 0), corner(quad, 1, 0), corner(quad, 1, 1);
    corner(quad, 0, 0), corner(quad, 1, 1), corner(quad, 0, 1);
}

static void draw_in_mesa(struct planes_canvas *canvas, const struct planes_quad *behind,
                         const struct planes_quad *front)
{
    static uint8_t rgb[WIDTH * HEIGHT][3];
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBegin(GL_TRIANGLES);
    if (behind != NULL) {
        quad_in(behind, PLANES_BEHIND);
    }
    if (front != NULL) {
        quad_in(front, PLANES_FRONT);
    }
    glEnd();
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        canvas->pixels[(HEIGHT - 1 - i / WIDTH) * WIDTH + i % WIDTH] = rgb[i][0];
    }
}

static void set_camera(const struct planes_canvas *canvas)
{
    const double n = depth_metres(lab.near_z), f = depth_metres(lab.far_z);
    const double right = n * 1048576 / canvas->projection.scale_x_q20,
                 top = n * 1048576 / canvas->projection.scale_y_q20;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-right, right, -top, top, n, f);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DITHER);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearColor(0, 0, 0, 0);
}

/* ---- the table -------------------------------------------------------------------------------------------- */

static double measure(struct planes_canvas *canvas, const struct ph_depth_format *format, GLuint buffer,
                      struct planes_lean lean)
{
    canvas->draw = NULL;
    if (buffer != 0) {
        CALL(PFNGLBINDFRAMEBUFFERPROC, "glBindFramebuffer")(GL_FRAMEBUFFER, buffer);
        canvas->draw = draw_in_mesa;
    }
    return depth_planes_sweep(canvas, format, lean).measured_m;
}

static int open_mesa(void **state)
{
    (void)state;
    if (!mesa_open(&gl, WIDTH, HEIGHT)) {
        return 0; /* the test skips */
    }
    for (int i = 0; i < FORMATS; i++) {
        buffers[i] = open_buffer(formats[i].format);
    }
    return 0;
}

static int close_mesa(void **state)
{
    (void)state;
    mesa_close(&gl);
    return 0;
}

/* With as many bits ours needs no larger separation than Mesa's; both are near the step of the format, plus what the
 * 8 sub-pixel bits cost that both have. */
static void ours_is_as_fine_as_mesa(void **state)
{
    (void)state;
    static const double distances[] = {5, 20, 50, 99}, tilts[] = {0, 30, 60, 75};
    printf("# %s\n# z [m]  tilt  Mesa: D16      D24       D32F      ours: fixed16   fixed24   float24   float16\n",
           gl.context != NULL ? (const char *)glGetString(GL_RENDERER) : "no OSMesa");
    for (size_t i = 0; i < 16; i++) {
        const struct planes_lean lean = {distances[i / 4], tilts[i % 4], 0};
        double mesa[FORMATS] = {0}, ours[FORMATS + 1];
        for (int k = 0; k <= FORMATS; k++) {
            const struct ph_depth_format *const format = k < FORMATS ? formats[k].ours : PH_DEPTH_FLOAT16;
            struct planes_canvas canvas;
            assert_int_equal(depth_planes_open(&canvas, &lab, format), 0);
            set_camera(&canvas);
            ours[k] = measure(&canvas, format, 0, lean);
            if (k < FORMATS && buffers[k] != 0) {
                mesa[k] = measure(&canvas, format, buffers[k], lean);
            }
            depth_planes_close(&canvas);
        }
        printf("# %5g  %4g      %-9.4g %-9.4g %-9.4g       %-9.4g %-9.4g %-9.4g %-9.4g\n", lean.at_m, lean.tilt_deg,
               mesa[0], mesa[1], mesa[2], ours[0], ours[1], ours[2], ours[3]);
        for (int k = 0; k < FORMATS; k++) {
            const double grid = 2.0 / 65536, subpixel = depth_subpixel_m(&lab, 8, lean.at_m) * sin(lean.tilt_deg / 57);
            if (buffers[k] != 0 && ours[k] > 1.1 * mesa[k] + grid + subpixel) {
                fail_msg("%s at %g m, %g degrees: Mesa %g, ours %g", formats[k].name, lean.at_m, lean.tilt_deg, mesa[k],
                         ours[k]);
            }
        }
    }
    for (int k = 0; k < FORMATS; k++) {
        if (buffers[k] == 0) {
            printf("# Mesa has no %s here: its column is missing\n", formats[k].name);
            skip();
        }
    }
}

/* Asked by LeakSanitizer: Mesa keeps some memory until the process ends. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa\n";
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ours_is_as_fine_as_mesa)};
    return cmocka_run_group_tests(tests, open_mesa, close_mesa);
}
