/* printf of start.c, for kernel_loops.c on RV32, for which there is no C library here. */
int printf(const char *format, ...);
