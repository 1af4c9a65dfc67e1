/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file posix.h  For system/posix.h alone: what mingw-w64 lacks of POSIX or has otherwise. Words and names of files are
 * UTF-8 in all of it, because depthprec.manifest says so.
 */
#ifndef WINDOWS_POSIX_H
#define WINDOWS_POSIX_H

#include <io.h>
#include <signal.h>
#include <stdint.h>

#define PATH_ENDS_FOLDER "/\\:"

/* ---- Files ------------------------------------------------------------------------------------------------------- */

/** Windows' own does not say which file it is. */
struct windows_stat {
    uint64_t st_dev, st_ino;
    int64_t st_size;
    unsigned st_mode;
};
int windows_stat(const char *path, struct windows_stat *out);
int windows_fstat(int fd, struct windows_stat *out);
#undef stat
#undef fstat
#define stat  windows_stat
#define fstat windows_fstat
#define lstat windows_stat

/** In binary; what is open may be removed. */
int windows_open(const char *path, int how, ...);
#define open(...) windows_open(__VA_ARGS__)
#define O_CLOEXEC O_NOINHERIT
FILE *windows_fopen(const char *path, const char *how);
#define fopen(path, how) windows_fopen(path, how)
ssize_t windows_write(int fd, const void *bytes, size_t size);
#define write(fd, bytes, size) windows_write(fd, bytes, size)

enum { F_GETFD };
int fcntl(int fd, int what);
#define fchmod(fd, mode) 0

char *realpath(const char *path, char *out);

/** Replaces a file that is there. */
int windows_rename(const char *from, const char *to);
#define rename(from, to) windows_rename(from, to)

/** At most four at a time; the bytes are there when it is closed. */
FILE *open_memstream(char **at, size_t *size);
int windows_fclose(FILE *stream);
#define fclose(stream) windows_fclose(stream)

struct winsize {
    unsigned short ws_col;
};
enum { TIOCGWINSZ };
int ioctl(int fd, int what, struct winsize *out);

/* ---- Signals, libraries ------------------------------------------------------------------------------------------ */

#define SIGHUP  SIGBREAK
#define SIGQUIT SIGTERM
#define SIGXFSZ NSIG /* which is none */

struct sigaction {
    void (*sa_handler)(int);
    int sa_mask;
};
#define sigemptyset(mask) (void)(mask)
int sigaction(int number, const struct sigaction *action, struct sigaction *before);

enum { RTLD_NOW, RTLD_LOCAL };
void *dlopen(const char *file, int how);
void *dlsym(void *library, const char *name);

/* ---- Text, time, order ------------------------------------------------------------------------------------------- */

char *strndup(const char *text, size_t most);
struct tm *gmtime_r(const time_t *when, struct tm *out);
void qsort_r(void *base, size_t count, size_t size, int (*compare)(const void *, const void *, void *), void *with);

/* Nobody calls setlocale(): numbers are those of the C locale. */
typedef const char *locale_t;
enum { LC_NUMERIC_MASK };
#define newlocale(mask, name, base) (name)
#define freelocale(locale)          (void)(locale)
static inline locale_t uselocale(locale_t locale) {
    return locale;
}

#endif
