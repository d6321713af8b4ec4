/*
 * version: the version of Pinhole, here and nowhere else. It follows semantic versioning 2.0: MAJOR grows when a
 * program that used a public header no longer compiles or draws other bytes without a reason given, MINOR when
 * something is new, PATCH when something is mended. Below 1.0.0 MINOR may do what MAJOR does.
 */
#ifndef PH_VERSION_H
#define PH_VERSION_H

/* MAJOR.MINOR.PATCH */
#define PH_VERSION "0.9.0"

#endif
