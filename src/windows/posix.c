/* SPDX-License-Identifier: GPL-3.0-or-later */
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <stdarg.h>

#include "system/pager.h"
#include "system/posix.h"
#include "system/sandbox.h"

/* ---- The console and the standard streams ------------------------------------------------------------------------ */

static UINT code_page;

static void leave_console(void) {
    SetConsoleOutputCP(code_page);
}

/* Bytes go through as they are; a console takes them as UTF-8, and what dresses them. */
__attribute__((constructor)) static void enter(void) {
    for (int fd = 0; fd <= 2; fd++) {
        DWORD mode;
        const HANDLE of = (HANDLE)_get_osfhandle(fd);
        _setmode(fd, _O_BINARY);
        if (fd == 0 || !GetConsoleMode(of, &mode))
            continue;
        SetConsoleMode(of, mode | 4 /* ENABLE_VIRTUAL_TERMINAL_PROCESSING */);
        if (code_page == 0 && (code_page = GetConsoleOutputCP()) != 0) {
            SetConsoleOutputCP(CP_UTF8);
            atexit(leave_console);
        }
    }
}

int ioctl(int fd, int what, struct winsize *out) {
    CONSOLE_SCREEN_BUFFER_INFO info;
    (void)what;
    if (!GetConsoleScreenBufferInfo((HANDLE)_get_osfhandle(fd), &info))
        return -1;
    out->ws_col = (unsigned short)(info.srWindow.Right - info.srWindow.Left + 1);
    return 0;
}

/* ---- Files ------------------------------------------------------------------------------------------------------- */

/* -1, with errno for what Windows says. */
static int failed(void) {
    const DWORD error = GetLastError();
    errno = error == ERROR_FILE_NOT_FOUND || error == ERROR_PATH_NOT_FOUND || error == ERROR_INVALID_NAME ? ENOENT
            : error == ERROR_FILE_EXISTS || error == ERROR_ALREADY_EXISTS                                 ? EEXIST
            : error == ERROR_DISK_FULL                                                                    ? ENOSPC
            : error == ERROR_INVALID_HANDLE                                                               ? EBADF
                                                                                                          : EACCES;
    return -1;
}

static HANDLE handle_of(const char *path, DWORD access, DWORD disposition, DWORD flags) {
    return CreateFileA(strcmp(path, "/dev/null") == 0 ? "NUL" : path, access,
                       FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, disposition, flags, NULL);
}

static int stat_handle(HANDLE of, struct windows_stat *out) {
    static uint64_t unknown; /* no two files that Windows does not identify are the same */
    BY_HANDLE_FILE_INFORMATION info;
    const DWORD type = of != INVALID_HANDLE_VALUE ? GetFileType(of) : FILE_TYPE_UNKNOWN;
    if (type == FILE_TYPE_UNKNOWN)
        return failed();
    *out = (struct windows_stat){.st_dev = UINT64_MAX, .st_ino = ++unknown};
    out->st_mode = type == FILE_TYPE_CHAR ? S_IFCHR : type == FILE_TYPE_PIPE ? S_IFIFO : S_IFREG;
    if (type != FILE_TYPE_DISK)
        return 0;
    if (!GetFileInformationByHandle(of, &info)) { /* Wine does not know of its standard streams which files they are */
        LARGE_INTEGER size = {.QuadPart = 0};
        GetFileSizeEx(of, &size);
        out->st_size = size.QuadPart;
        return 0;
    }
    *out =
        (struct windows_stat){.st_dev = info.dwVolumeSerialNumber,
                              .st_ino = (uint64_t)info.nFileIndexHigh << 32 | info.nFileIndexLow,
                              .st_size = (int64_t)((uint64_t)info.nFileSizeHigh << 32 | info.nFileSizeLow),
                              .st_mode = (info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? S_IFDIR : S_IFREG};
    return 0;
}

int windows_fstat(int fd, struct windows_stat *out) {
    return stat_handle((HANDLE)_get_osfhandle(fd), out);
}

int windows_stat(const char *path, struct windows_stat *out) {
    const HANDLE of = handle_of(path, 0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
    const int result = stat_handle(of, out);
    if (of != INVALID_HANDLE_VALUE)
        CloseHandle(of);
    return result;
}

int windows_open(const char *path, int how, ...) {
    const DWORD access = (how & (O_WRONLY | O_RDWR)) != 0 ? GENERIC_WRITE : GENERIC_READ;
    const DWORD disposition = (how & O_EXCL) != 0 ? CREATE_NEW : (how & O_CREAT) != 0 ? OPEN_ALWAYS : OPEN_EXISTING;
    const HANDLE of = handle_of(path, access, disposition, FILE_ATTRIBUTE_NORMAL);
    struct windows_stat found;
    if (of != INVALID_HANDLE_VALUE)
        return _open_osfhandle((intptr_t)of, _O_BINARY | (how & O_NOINHERIT));
    failed();
    if (errno == EACCES && windows_stat(path, &found) == 0 && S_ISDIR(found.st_mode))
        errno = EISDIR;
    return -1;
}

FILE *windows_fopen(const char *path, const char *how) {
    const int fd = windows_open(path, O_RDONLY);
    return fd >= 0 ? _fdopen(fd, how) : NULL;
}

ssize_t windows_write(int fd, const void *bytes, size_t size) {
    const int written = _write(fd, bytes, size < 1 << 30 ? (unsigned)size : 1 << 30);
    if (written < 0 && GetFileType((HANDLE)_get_osfhandle(fd)) == FILE_TYPE_PIPE)
        errno = EPIPE;
    return written;
}

int fcntl(int fd, int what) {
    (void)what;
    if (_get_osfhandle(fd) >= 0)
        return 0;
    errno = EBADF;
    return -1;
}

char *realpath(const char *path, char *out) {
    return _fullpath(out, path, 0);
}

int windows_rename(const char *from, const char *to) {
    return MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING) ? 0 : failed();
}

/* ---- Streams into memory, which are files here ------------------------------------------------------------------- */

static struct {
    FILE *stream;
    char **at;
    size_t *size;
} memory[4];

FILE *open_memstream(char **at, size_t *size) {
    char folder[MAX_PATH + 1], name[MAX_PATH + 1];
    size_t slot = 0;
    while (slot < 4 && memory[slot].stream != NULL)
        slot++;
    if (slot == 4 || GetTempPathA(sizeof folder, folder) == 0 || GetTempFileNameA(folder, "dep", 0, name) == 0)
        return NULL;
    const int fd = _open(name, _O_RDWR | _O_BINARY | _O_TEMPORARY);
    FILE *stream = fd >= 0 ? _fdopen(fd, "w+b") : NULL;
    memory[slot].stream = stream;
    memory[slot].at = at;
    memory[slot].size = size;
    return stream;
}

static bool take_back(FILE *stream, char **at, size_t *size) {
    const bool written = ferror(stream) == 0 && fflush(stream) == 0;
    const int64_t length = _ftelli64(stream);
    char *bytes = written && length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (bytes == NULL)
        return false;
    rewind(stream);
    *at = bytes;
    *size = fread(bytes, 1, (size_t)length, stream);
    bytes[*size] = '\0';
    return *size == (size_t)length;
}

#undef fclose
int windows_fclose(FILE *stream) {
    bool taken = true;
    for (size_t i = 0; i < 4; i++)
        if (memory[i].stream == stream) {
            taken = take_back(stream, memory[i].at, memory[i].size);
            memory[i].stream = NULL;
        }
    return fclose(stream) == 0 && taken ? 0 : EOF;
}

/* ---- Signals, libraries, processes ------------------------------------------------------------------------------- */

int sigaction(int number, const struct sigaction *action, struct sigaction *before) {
    void (*const was)(int) = signal(number, action != NULL ? action->sa_handler : SIG_IGN);
    if (was == SIG_ERR)
        return -1;
    if (action == NULL)
        signal(number, was);
    if (before != NULL)
        before->sa_handler = was;
    return 0;
}

void *dlopen(const char *file, int how) {
    (void)how;
    return (void *)LoadLibraryA(file);
}

void *dlsym(void *library, const char *name) {
    const FARPROC found = GetProcAddress((HMODULE)library, name);
    void *out;
    memcpy(&out, &found, sizeof out);
    return out;
}

sandbox_end sandbox_run(bool (*work)(void *of, FILE *out), void *of, sandbox_limits limits, FILE **made) {
    (void)work, (void)of, (void)limits;
    *made = NULL;
    errno = ENOSYS; /* there is no fork() */
    return SANDBOX_NO_PROCESS;
}

void sandbox_close(FILE *made) {
    (void)made;
}

int pager_start(void) {
    return -1;
}

void pager_wait(void) {}

/* ---- Text, time, order ------------------------------------------------------------------------------------------- */

char *strndup(const char *text, size_t most) {
    const size_t length = strnlen(text, most);
    char *out = calloc(length + 1, 1);
    return out != NULL ? memcpy(out, text, length) : NULL;
}

struct tm *gmtime_r(const time_t *when, struct tm *out) {
    return gmtime_s(out, when) == 0 ? out : NULL;
}

static _Thread_local struct {
    int (*compare)(const void *, const void *, void *);
    void *with;
} order;

static int ordered(const void *a, const void *b) {
    return order.compare(a, b, order.with);
}

void qsort_r(void *base, size_t count, size_t size, int (*compare)(const void *, const void *, void *), void *with) {
    order.compare = compare;
    order.with = with;
    qsort(base, count, size, ordered);
}
