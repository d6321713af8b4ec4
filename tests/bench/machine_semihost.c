/* See machine_bare.h: the calls of Arm's "Semihosting for AArch32 and AArch64", whose numbers RISC-V has, too. */
#include "machine_bare.h"

void machine_quit(int status)
{
    const uint32_t block[2] = {0x20026, (uint32_t)status}; /* ADP_Stopped_ApplicationExit */
    machine_semihost(0x20, block);                         /* SYS_EXIT_EXTENDED */
}

void machine_command_line(char *text, uint32_t size)
{
    const uintptr_t block[2] = {(uintptr_t)text, size};
    machine_semihost(0x15, block); /* SYS_GET_CMDLINE */
}
