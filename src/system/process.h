/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file process.h  What the program calls of POSIX around itself: libraries that it loads, signals, its terminal. */
#ifndef SYSTEM_PROCESS_H
#define SYSTEM_PROCESS_H

#include "system/posix.h"

#ifndef _WIN32
#include <dlfcn.h>
#include <signal.h>
#include <sys/ioctl.h>
#endif

#endif
