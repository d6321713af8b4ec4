/* What clang's library of 128-bit numbers for wasm32 (libclang_rt.builtins, as Debian compiles it) expects of a C
 * library, and wasi-libc does not have: the guard of its stack frames. */
#include <stdlib.h>

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
unsigned long __stack_chk_guard = 0x600df00d;
_Noreturn void __stack_chk_fail(void);

void __stack_chk_fail(void)
{
    abort();
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
