/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report/message.h"
#include "system/input.h"
#include "system/pager.h"
#include "system/process.h"

/* The temporary files, for the signal handler: empty where there is none. */
typedef char temporary_path[4096 + 64];
static temporary_path temporaries[OUTPUTS_MAX];

static const int deadly[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM};

static void remove_and_die(int number) {
    for (int i = 0; i < OUTPUTS_MAX; i++)
        if (temporaries[i][0] != '\0')
            unlink(temporaries[i]);
    signal(number, SIG_DFL);
    raise(number);
}

/* A signal that the parent made us ignore (nohup, a background job) stays ignored. */
static void watch_signals(void) {
    struct sigaction action = {.sa_handler = remove_and_die};
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof deadly / sizeof deadly[0]; i++) {
        struct sigaction before;
        if (sigaction(deadly[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(deadly[i], &action, NULL);
    }
    signal(SIGXFSZ, SIG_IGN); /* so that a file size limit is a failed write, not a death */
}

static int cannot_write(const char *path, int error) {
    if (path == NULL)
        message("depthprec: cannot write to stdout: %s", strerror(error));
    else
        message("depthprec: cannot write '%s': %s", path, strerror(error));
    return EXIT_IO;
}

static int refuse_input(const char *path) {
    message("depthprec: '%s' is a file that is read, and is not overwritten", path);
    return EXIT_USAGE;
}

/* Opens the target's temporary neighbour, which is named after the process and not after it: no name too long. */
static int open_temporary(output *out, const struct stat *old) {
    const char *target = out->target;
    const int folder = (int)(path_name(target) - target);
    int slot = 0;
    while (slot < OUTPUTS_MAX - 1 && temporaries[slot][0] != '\0')
        slot++;
    char *const temporary = out->temporary = temporaries[slot];
    const int length = snprintf(temporary, sizeof temporaries[slot], "%.*s.depthprec-%ld%s.tmp", folder, target,
                                (long)getpid(), slot > 0 ? "b" : "");
    if (length < 0 || (size_t)length >= sizeof temporaries[slot]) {
        temporary[0] = '\0';
        errno = ENAMETOOLONG;
        return -1;
    }
    watch_signals();
    unlink(temporary); /* only a killed process of the same number can have left one */
    int fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0)
        temporary[0] = '\0';
    else if (old != NULL)
        (void)!fchmod(fd, old->st_mode & 0777);
    return fd;
}

int output_open(output *out, const char *path) {
    *out = (output){.fd = STDOUT_FILENO};
    if (path == NULL || strcmp(path, "-") == 0)
        return EXIT_FINE;
    out->path = path;
    if (input_is_read(path))
        return refuse_input(path);
    struct stat old;
    struct stat standard;
    bool exists = stat(path, &old) == 0;
    bool link = !exists && lstat(path, &old) == 0; /* a symbolic link that points nowhere yet */
    if (exists && fstat(STDOUT_FILENO, &standard) == 0 && standard.st_dev == old.st_dev &&
        standard.st_ino == old.st_ino && !S_ISDIR(old.st_mode))
        return EXIT_FINE; /* /dev/stdout by any name: to replace the file would cut off what the shell writes to it */
    if (link || (exists && !S_ISREG(old.st_mode))) {
        out->fd = open(path, O_WRONLY | O_CLOEXEC | (link ? O_CREAT : 0), 0666);
        return out->fd < 0 ? cannot_write(path, errno) : EXIT_FINE;
    }
    if (exists && access(path, W_OK) != 0) /* a rename would not care, but the owner does */
        return cannot_write(path, errno);
    out->target = exists ? realpath(path, NULL) : strdup(path); /* a link to a file stays a link */
    if (out->target == NULL)
        return cannot_write(path, errno);
    out->fd = open_temporary(out, exists ? &old : NULL);
    if (out->fd >= 0)
        return EXIT_FINE;
    int error = errno;
    free(out->target);
    out->target = NULL;
    return cannot_write(path, error);
}

int output_check(const char *path) {
    output out;
    struct stat old;
    const bool exists = stat(path, &old) == 0;
    if (exists ? !S_ISREG(old.st_mode) && !S_ISDIR(old.st_mode) : lstat(path, &old) == 0)
        return EXIT_FINE;
    const int status = output_open(&out, path);
    if (status == EXIT_FINE)
        output_abandon(&out);
    return status;
}

void output_page(output *out) {
    const int fd = out->fd == STDOUT_FILENO ? pager_start() : -1;
    out->paged = fd >= 0;
    out->fd = out->paged ? fd : out->fd;
}

/* The file that a path would name, though it may not be there: its folder's identity and the name in it. */
static bool name_in_folder(const char *path, struct stat *folder, const char **name) {
    *name = path_name(path);
    char *copy = *name == path ? strdup(".") : strndup(path, (size_t)(*name - path));
    const bool known = copy != NULL && stat(copy, folder) == 0;
    free(copy);
    return known;
}

bool output_same_file(const char *a, const char *b) {
    struct stat x, y;
    const char *name_x, *name_y;
    const bool is_x = stat(a, &x) == 0, is_y = stat(b, &y) == 0;
    if (is_x && is_y)
        return S_ISREG(x.st_mode) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
    return !is_x && !is_y && name_in_folder(a, &x, &name_x) && name_in_folder(b, &y, &name_y) && x.st_dev == y.st_dev &&
           x.st_ino == y.st_ino && strcmp(name_x, name_y) == 0;
}

void output_reserve_streams(void) {
    static const int wrong_way[] = {[STDIN_FILENO] = O_WRONLY, [STDOUT_FILENO] = O_RDONLY, [STDERR_FILENO] = O_RDONLY};
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 && errno == EBADF)
            (void)!open("/dev/null", wrong_way[fd]);
}

FILE *output_stream(output *out) {
    const int fd = dup(out->fd);
    FILE *stream = fd >= 0 ? fdopen(fd, "wb") : NULL;
    if (fd >= 0 && stream == NULL)
        close(fd);
    return stream;
}

bool output_stream_close(output *out, FILE *stream) {
    const bool failed = ferror(stream) != 0;
    errno = 0;
    if ((fclose(stream) != 0 || failed) && out->error == 0)
        out->error = errno != 0 ? errno : EIO;
    return out->error == 0;
}

static void drop_temporary(output *out) {
    if (out->temporary != NULL && out->temporary[0] != '\0')
        unlink(out->temporary);
    if (out->temporary != NULL)
        out->temporary[0] = '\0';
    free(out->target);
    out->target = NULL;
}

void output_abandon(output *out) {
    if (out->fd != STDOUT_FILENO)
        close(out->fd);
    drop_temporary(out);
}

/* A file that was opened to be read after this one was to be written. */
static int give_up_on_input(output *out) {
    output_abandon(out);
    return refuse_input(out->path);
}

int output_close(output *out) {
    output_flush(out);
    if (out->target != NULL && input_is_read(out->target))
        return give_up_on_input(out);
    if (close(out->fd) != 0 && out->error == 0 && errno != EINTR)
        out->error = errno;
    if (out->paged)
        pager_wait();
    if (out->target != NULL && out->error == 0) {
        if (rename(out->temporary, out->target) == 0)
            out->temporary[0] = '\0';
        else
            out->error = errno;
    }
    drop_temporary(out);
    if (out->error == EPIPE) /* the reader has seen enough */
        return out->paged ? EXIT_FINE : EXIT_IO;
    return out->error == 0 ? EXIT_FINE : cannot_write(out->path, out->error);
}
