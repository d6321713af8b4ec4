// SPDX-License-Identifier: Dual MIT/GPL
/* The events, as text in a ring. Written from any context, read from /dev/virtual-board. */
#include "board.h"

#include <linux/fs.h>
#include <linux/ktime.h>
#include <linux/miscdevice.h>
#include <linux/mutex.h>
#include <linux/sched.h>
#include <linux/slab.h>
#include <linux/spinlock.h>
#include <linux/uaccess.h>
#include <linux/vmalloc.h>
#include <linux/wait.h>

#define LINE_MAX 8192

static struct {
    char *ring;
    size_t size, head, count;
    char line[LINE_MAX]; /* being written */
    unsigned int lost;
    u64 start;
    bool follow;
    spinlock_t lock;
    struct mutex reader;
    wait_queue_head_t changed;
} events;

u64 board_now(void)
{
    return ktime_get_ns() - events.start;
}

static void put(const char *text, size_t n)
{
    size_t at = (events.head + events.count) % events.size;
    size_t first = min(n, events.size - at);

    memcpy(events.ring + at, text, first);
    memcpy(events.ring, text + first, n - first);
    events.count += n;
}

/* Events that found no room are counted, and told as soon as there is some. */
static void tell_lost(void)
{
    char text[64];
    int n;

    if (!events.lost)
        return;
    n = scnprintf(text, sizeof(text), "%llu lost %u\n", board_now(), events.lost);
    if (n <= events.size - events.count) {
        put(text, n);
        events.lost = 0;
    }
}

/* events.lock is held, events.line has n characters */
static void put_line(int n)
{
    events.line[n++] = '\n';
    tell_lost();
    if (n <= events.size - events.count)
        put(events.line, n);
    else
        events.lost++;
}

void board_log(const char *format, ...)
{
    unsigned long flags;
    va_list arguments;

    spin_lock_irqsave(&events.lock, flags);
    va_start(arguments, format);
    put_line(vscnprintf(events.line, LINE_MAX - 1, format, arguments));
    va_end(arguments);
    spin_unlock_irqrestore(&events.lock, flags);
    wake_up_interruptible(&events.changed);
}

void board_log_bytes(const u8 *bytes, size_t n, const char *format, ...)
{
    unsigned long flags;
    va_list arguments;
    int used;

    spin_lock_irqsave(&events.lock, flags);
    va_start(arguments, format);
    used = vscnprintf(events.line, LINE_MAX - 1, format, arguments);
    va_end(arguments);
    n = min_t(size_t, n, (LINE_MAX - 1 - used) / 2);
    bin2hex(events.line + used, bytes, n);
    put_line(used + 2 * n);
    spin_unlock_irqrestore(&events.lock, flags);
    wake_up_interruptible(&events.changed);
}

void board_log_room(size_t n)
{
    wait_event_timeout(events.changed, events.size - READ_ONCE(events.count) >= n + 512, 10 * HZ);
}

void board_log_follow(bool on)
{
    WRITE_ONCE(events.follow, on);
    wake_up_interruptible(&events.changed);
}

static ssize_t log_read(struct file *file, char __user *to, size_t n, loff_t *offset)
{
    size_t part;
    int error = 0;

    if (wait_event_interruptible(events.changed, READ_ONCE(events.count) || !READ_ONCE(events.follow)))
        return -ERESTARTSYS;
    mutex_lock(&events.reader);
    part = min3(n, READ_ONCE(events.count), events.size - events.head);
    if (copy_to_user(to, events.ring + events.head, part)) {
        error = -EFAULT;
    } else {
        spin_lock_irq(&events.lock);
        events.head = (events.head + part) % events.size;
        events.count -= part;
        spin_unlock_irq(&events.lock);
    }
    mutex_unlock(&events.reader);
    wake_up(&events.changed);
    return error ? error : part;
}

static ssize_t log_write(struct file *file, const char __user *from, size_t n, loff_t *offset)
{
    char *text, *rest, *line;
    int status = 0;

    if (n > LINE_MAX)
        return -EINVAL;
    text = memdup_user_nul(from, n);
    if (IS_ERR(text))
        return PTR_ERR(text);
    rest = text;
    while (!status && (line = strsep(&rest, "\n")))
        status = *line ? board_command(line) : 0;
    kfree(text);
    return status ? status : n;
}

const struct file_operations board_log_fops = {
    .owner = THIS_MODULE,
    .read = log_read,
    .write = log_write,
    .llseek = noop_llseek,
};

int board_log_init(size_t bytes)
{
    events.size = bytes;
    events.ring = vmalloc(bytes);
    events.start = ktime_get_ns();
    spin_lock_init(&events.lock);
    mutex_init(&events.reader);
    init_waitqueue_head(&events.changed);
    return events.ring ? 0 : -ENOMEM;
}

void board_log_exit(void)
{
    vfree(events.ring);
}
