#!/usr/bin/env bash
# The firmware's objects for Cortex-M0+ and Cortex-M3 keep its promises: no floating point, no heap, nothing mutable at file
# scope, no recursion, a bounded stack. Each check is also tried on an object that breaks the promise.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
stack_max=6144 # bytes, deepest path below any public function; the fisheye's stack of waiting pieces takes the most
library_stack=80 # bytes, taken for each call into libgcc or libc: __udivmoddi4, the deepest, takes 64 on M0+

command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# Firmware takes nothing from libgcc and libc but integer arithmetic and plain memory.
allowed='^(__aeabi_(lmul|u?idiv|u?idivmod|u?ldivmod|llsl|llsr|lasr|u?lcmp|mem(cpy|set|clr|move)[48]?)|__gnu_thumb1_case_[a-z]+|__c[lt]z[sd]i2|mem(cpy|set|move|cmp)|str(cmp|len))$'

foreign_symbols() { # objects: what is used but not defined in them, nor allowed
    arm-none-eabi-ld -r -o "$dir/all.o" "$@" && arm-none-eabi-nm -u "$dir/all.o" | awk '{ print $2 }' | grep -vE "$allowed"
}

written_objects() { arm-none-eabi-nm "$@" | grep -E ' [bBdDC] '; }

stack_faults() { awk -v most="$stack_max" -v library="$library_stack" -f firmware/tools/stack.awk "$@"; } # call graph files

build() { # CPU, -mcpu=
    make -s -j"$(nproc)" B="$B/objects-$1" CC=arm-none-eabi-gcc CPU="$1" \
        CFLAGS="-mcpu=$2 -mthumb -O2 -fcallgraph-info=su" firmware-objects
}

none() { # command that prints faults, files
    local found
    [ $# -gt 1 ] || { echo "nothing to look at" && return 1; }
    found=$("$@" 2>"$dir/said")
    [ -z "$found" ] || { echo "$found" && return 1; }
}

# The check must object to this C text.
objects_to() { # pattern in what it says, "symbols" | "stack" | "written", C text
    echo "$3" >"$dir/wrong.c"
    arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -O1 -fno-builtin -fno-optimize-sibling-calls -fcallgraph-info=su \
        -c "$dir/wrong.c" -o "$dir/wrong.o" || return 1
    local said
    case $2 in
    symbols) said=$(foreign_symbols "$dir/wrong.o") ;;
    stack) said=$(stack_faults "$dir"/wrong.ci 2>&1) ;;
    written) said=$(written_objects "$dir/wrong.o") ;;
    esac
    grep -q "$1" <<<"$said" || { echo "said: $said" && return 1; }
}

check "the_check_sees_floating_point" objects_to __aeabi_fmul symbols 'float f(float x); float f(float x) { return x * x; }'
check "the_check_sees_the_heap" objects_to malloc symbols 'void *malloc(unsigned); void *f(void); void *f(void) { return malloc(4); }'
check "the_check_sees_recursion" objects_to recursion stack 'int g(int); int f(int n); int f(int n) { return n ? g(f(n - 1)) : 0; }'
check "the_check_sees_a_large_frame" objects_to 'stack: f' stack 'void g(char *); void f(void); void f(void) { char big[6200]; g(big); }'
check "the_check_sees_a_VLA" objects_to dynamic stack 'void g(char *); void f(int n); void f(int n) { char big[n]; g(big); }'
check "the_check_sees_recursion_through_a_member" objects_to recursion stack '
struct s { int (*up)(int n); }; extern struct s all[]; static int f(int n)
{
    return n ? all[n].up(n - 1) + 1 : 0;
}
struct s all[] = {{.up = f}, {.up = 0}};'
check "the_check_sees_recursion_through_an_argument" objects_to recursion stack '
int g(int (*run)(int)); int g(int (*run)(int))
{
    return run(3) + 1;
}
int f(int n); int f(int n) /* called as run */
{
    return n ? g(f) + 1 : 0;
}'
check "the_check_sees_a_function_that_is_given_away" objects_to 'f is given away' stack 'int g(int (*run)(int)); int f(int n); int f(int n) { return n ? g(f) + 1 : 0; }'
check "the_check_sees_a_misspelt_name" objects_to 'f is called as rnu' stack '
int g(int (*run)(int)); int g(int (*run)(int))
{
    return run(3) + 1;
}
int f(int n); int f(int n) /* called as rnu */
{
    return n ? g(f) + 1 : 0;
}'
check "the_check_sees_a_pointer_without_a_name" objects_to 'it has no name' stack 'int f(long n); int f(long n) { return ((int (*)(void))n)() + 1; }'
check "the_check_sees_a_static_variable" objects_to count written 'int f(void); int f(void) { static int count; return count++; }'

for cpu in "armv6m cortex-m0plus" "armv7m cortex-m3"; do
    read -r folder core <<<"$cpu"
    rm -rf "$B/objects-$folder"
    check "the_firmware_compiles_for_$core" build "$folder" "$core"
    mapfile -t objects < <(find "$B/objects-$folder/firmware" "$B/objects-$folder/hal" -name '*.o')
    mapfile -t graphs < <(find "$B/objects-$folder/firmware" "$B/objects-$folder/hal" -name '*.ci') # assembly has none
    check "no_floating_point_no_heap_no_io_on_$core" none foreign_symbols "${objects[@]}"
    check "nothing_is_mutable_at_file_scope_on_$core" none written_objects "${objects[@]}"
    check "no_recursion_and_at_most_${stack_max}_bytes_of_stack_on_$core" none stack_faults "${graphs[@]}"
    cat "$dir/said"
done
tap_end
