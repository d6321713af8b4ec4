/* As the Arduino library has it: all public headers. */
#include <pinhole/blur.h>
#include <pinhole/camera.h>
#include <pinhole/motion.h>
#include <pinhole/overlay.h>
#include <pinhole/render.h>
#include <pinhole/shadow.h>
