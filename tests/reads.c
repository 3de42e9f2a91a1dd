/* Preloaded into what tests start: writes the files and folders below READS_BELOW that a process opens, and its own
   name, into the file READS_TO, a line each. FreeFEM asks for its CPU time at every block of a script, a fifth of a run:
   here the answer is renewed with each tick of the coarse clock, every 4 ms. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static const char *below;
static size_t length;
static int log_file = -1;

static void write_line(const char *kind, const char *name) {
  char line[PATH_MAX + 16];
  int n = snprintf(line, sizeof line, "%s %s\n", kind, name);
  if (n <= 0 || n >= (int)sizeof line) return;
  /* a limit of the size of files, which a test may set, must not end the process here */
  sigset_t beyond, before;
  struct timespec none = {0, 0};
  sigemptyset(&beyond);
  sigaddset(&beyond, SIGXFSZ);
  sigprocmask(SIG_BLOCK, &beyond, &before);
  if (write(log_file, line, n) < 0) {
    char lost[PATH_MAX];
    sigtimedwait(&beyond, NULL, &none);
    snprintf(lost, sizeof lost, "%s.lost", getenv("READS_TO"));
    close(syscall(SYS_openat, AT_FDCWD, lost, O_WRONLY | O_CREAT, 0666));
  }
  sigprocmask(SIG_SETMASK, &before, NULL);
}

__attribute__((constructor)) static void begin(void) {
  const char *to = getenv("READS_TO");
  below = getenv("READS_BELOW");
  if (!to || !below) return;
  length = strlen(below);
  int opened = syscall(SYS_openat, AT_FDCWD, to, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (opened < 0) return;
  log_file = fcntl(opened, F_DUPFD_CLOEXEC, 200); /* out of the way of shells that choose numbers themselves */
  close(opened);
  char name[PATH_MAX];
  ssize_t n = readlink("/proc/self/exe", name, sizeof name - 1);
  if (n > 0) name[n] = 0, write_line("program", name);
}

static int tell(int fd) {
  if (fd < 0 || log_file < 0) return fd;
  char link[32], name[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  ssize_t n = readlink(link, name, sizeof name - 1);
  if (n > (ssize_t)length && !strncmp(name, below, length)) name[n] = 0, write_line("read", name + length + 1);
  return fd;
}

#define MODE(flags) \
  int mode = 0; \
  if (flags & (O_CREAT | O_TMPFILE)) { va_list rest; va_start(rest, flags); mode = va_arg(rest, int); va_end(rest); }
#define REAL(name) static __typeof__(&name) real; if (!real) real = dlsym(RTLD_NEXT, #name)

int open(const char *path, int flags, ...) { REAL(open); MODE(flags) return tell(real(path, flags, mode)); }
int open64(const char *path, int flags, ...) { REAL(open64); MODE(flags) return tell(real(path, flags, mode)); }
int openat(int at, const char *path, int flags, ...) { REAL(openat); MODE(flags) return tell(real(at, path, flags, mode)); }
int openat64(int at, const char *path, int flags, ...) { REAL(openat64); MODE(flags) return tell(real(at, path, flags, mode)); }

static FILE *told(FILE *file) {
  if (file) tell(fileno(file));
  return file;
}
FILE *fopen(const char *path, const char *mode) { REAL(fopen); return told(real(path, mode)); }
FILE *fopen64(const char *path, const char *mode) { REAL(fopen64); return told(real(path, mode)); }
DIR *opendir(const char *path) {
  REAL(opendir);
  DIR *dir = real(path);
  if (dir) tell(dirfd(dir));
  return dir;
}

clock_t clock(void) {
  static clock_t used; /* never the same twice: what a block took may stand in a quotient */
  static struct timespec before;
  struct timespec now, cpu;
  clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  if (now.tv_nsec != before.tv_nsec || now.tv_sec != before.tv_sec) {
    before = now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    clock_t full = cpu.tv_sec * CLOCKS_PER_SEC + cpu.tv_nsec / 1000;
    if (full > used) used = full;
  }
  return ++used;
}
