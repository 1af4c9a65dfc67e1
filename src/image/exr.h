/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file exr.h  The OpenEXR library of the headers that this is compiled with; nothing where there are none. */
#ifndef IMAGE_EXR_H
#define IMAGE_EXR_H

#if __has_include(<openexr.h>)

#include <openexr.h>

/** The file and Debian's package: versions 3.M have the number 29 + M in both names. */
#if OPENEXR_VERSION_MINOR == 1
#define IMAGE_EXR_FILE    "libOpenEXRCore-3_1.so.30"
#define IMAGE_EXR_PACKAGE "libopenexr-3-1-30"
#elif OPENEXR_VERSION_MINOR == 2
#define IMAGE_EXR_FILE    "libOpenEXRCore-3_2.so.31"
#define IMAGE_EXR_PACKAGE "libopenexr-3-2-31"
#elif OPENEXR_VERSION_MINOR == 3
#define IMAGE_EXR_FILE    "libOpenEXRCore-3_3.so.32"
#define IMAGE_EXR_PACKAGE "libopenexr-3-3-32"
#else
#define IMAGE_EXR_FILE    "libOpenEXRCore-3_4.so.33"
#define IMAGE_EXR_PACKAGE "libopenexr-3-4-33"
#endif

#endif

#endif
