/*
 * The first process of the guest (see guest.sh): puts together a root that is the host's below a memory file system,
 * runs /run/guest/command in it and powers off. The host looks for /run/guest/status; without it the guest has died.
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/reboot.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#define P9 "trans=virtio,version=9p2000.L,msize=512000"

static void power_off(void)
{
    sync();
    reboot(RB_AUTOBOOT); /* QEMU is told not to start again: the fastest way to end */
    for (;;) {
        pause();
    }
}

static void must(int result, const char *what)
{
    if (result < 0) {
        perror(what);
        power_off();
    }
}

static void insert_module(const char *path)
{
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    must(file, path);
    must((int)syscall(SYS_finit_module, file, "", 0), path);
    close(file);
}

/* Inserts the modules in the order of the numbers with which their names begin: the order in which they need each
 * other. */
static void insert_modules(void)
{
    struct dirent **list = NULL;
    const int n = scandir("/modules", &list, NULL, alphasort);
    for (int i = 0; i < n; i++) {
        char path[300];
        snprintf(path, sizeof path, "/modules/%s", list[i]->d_name);
        if (list[i]->d_name[0] != '.') {
            insert_module(path);
        }
    }
}

static void must_mount(const char *source, const char *target, const char *type, unsigned long flags, const char *data)
{
    mkdir(target, 0755);
    must(mount(source, target, type, flags, data), target);
}

static void make_root(void)
{
    must_mount("dev", "/dev", "devtmpfs", 0, NULL);
    must_mount("host", "/host", "9p", MS_RDONLY, P9 ",cache=loose");
    must_mount("memory", "/memory", "tmpfs", 0, "mode=755");
    mkdir("/memory/upper", 0755);
    mkdir("/memory/work", 0755);
    must_mount("system", "/system", "overlay", 0, "lowerdir=/host,upperdir=/memory/upper,workdir=/memory/work");
    must_mount("/dev", "/system/dev", NULL, MS_MOVE, NULL);
    must_mount("proc", "/system/proc", "proc", 0, NULL);
    must_mount("sys", "/system/sys", "sysfs", 0, NULL);
    must_mount("run", "/system/run", "tmpfs", 0, "mode=755");
    must_mount("guest", "/system/run/guest", "9p", 0, P9);
    must(chdir("/system"), "chdir");
    must(mount(".", "/", NULL, MS_MOVE, NULL), "root");
    must(chroot("."), "chroot");
    mkdir("/dev/shm", 01777);
    must_mount("shm", "/dev/shm", "tmpfs", 0, NULL);
    mkdir("/dev/pts", 0755);
    must_mount("pts", "/dev/pts", "devpts", 0, NULL);
}

static void redirect(const char *path, int flags, int target)
{
    const int file = open(path, flags, 0644);
    must(file, path);
    must(dup2(file, target), path);
    close(file);
}

/* Exit status of a shell that is given two arguments. */
static int run(const char *option, const char *command, const char *out, const char *error)
{
    const pid_t child = fork();
    must(child, "fork");
    if (child == 0) {
        redirect("/dev/null", O_RDONLY, STDIN_FILENO);
        redirect(out, O_WRONLY | O_CREAT | O_APPEND, STDOUT_FILENO);
        redirect(error, O_WRONLY | O_CREAT | O_APPEND, STDERR_FILENO);
        setsid();
        execl("/bin/bash", "bash", option, command, (char *)NULL);
        _exit(127);
    }
    int status = 0;
    while (waitpid(child, &status, 0) != child) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int main(void)
{
    insert_modules();
    make_root();
    const int status = run("--", "/run/guest/command", "/run/guest/stdout", "/run/guest/stderr");
    run("-c", "dmesg", "/run/guest/kernel.log", "/run/guest/kernel.log");
    FILE *file = fopen("/run/guest/status", "w");
    if (file != NULL) {
        fprintf(file, "%d\n", status);
        fclose(file);
    }
    power_off();
    return 0;
}
