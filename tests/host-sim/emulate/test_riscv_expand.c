/* riscv_expand: compressed instructions against what GNU as makes of each and of the instruction of 32 bits that the
 * ISA manual (volume I, chapter 16) gives for it; and codes that are none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "rp2350/riscv.h"

static const struct {
    uint16_t code;
    uint32_t whole;
    const char *text;
} pairs[] = {
    {0x0040, 0x00410413, "c.addi4spn x8,sp,4"},
    {0x1ffc, 0x3fc10793, "c.addi4spn x15,sp,1020"},
    {0x12ac, 0x16810593, "c.addi4spn x11,sp,360"},
    {0x4080, 0x0004a403, "c.lw x8,0(x9)"},
    {0x5c7c, 0x07c42783, "c.lw x15,124(x8)"},
    {0x42c8, 0x0046a503, "c.lw x10,4(x13)"},
    {0x4330, 0x04072603, "c.lw x12,64(x14)"},
    {0xc080, 0x0084a023, "c.sw x8,0(x9)"},
    {0xdc7c, 0x06f42e23, "c.sw x15,124(x8)"},
    {0xc174, 0x04d52223, "c.sw x13,68(x10)"},
    {0xc784, 0x0097a423, "c.sw x9,8(x15)"},
    {0x0001, 0x00000013, "c.nop"},
    {0x1f81, 0xfe0f8f93, "c.addi x31,-32"},
    {0x00fd, 0x01f08093, "c.addi x1,31"},
    {0x3001, 0x801ff0ef, "c.jal .-2048"},
    {0x2ffd, 0x7fe000ef, "c.jal .+2046"},
    {0x2b99, 0x556000ef, "c.jal .+1366"},
    {0x246d, 0x2aa000ef, "c.jal .+682"},
    {0xbffd, 0xfffff06f, "c.j .-2"},
    {0xa101, 0x4000006f, "c.j .+1024"},
    {0xa081, 0x0400006f, "c.j .+64"},
    {0x52fd, 0xfff00293, "c.li x5,-1"},
    {0x4fd5, 0x01500f93, "c.li x31,21"},
    {0x7101, 0xe0010113, "c.addi16sp sp,-512"},
    {0x617d, 0x1f010113, "c.addi16sp sp,496"},
    {0x614d, 0x0b010113, "c.addi16sp sp,176"},
    {0x6085, 0x000010b7, "c.lui x1,1"},
    {0x7f81, 0xfffe0fb7, "c.lui x31,0xfffe0"},
    {0x61fd, 0x0001f1b7, "c.lui x3,31"},
    {0x8005, 0x00145413, "c.srli x8,1"},
    {0x83fd, 0x01f7d793, "c.srli x15,31"},
    {0x84c1, 0x4104d493, "c.srai x9,16"},
    {0x877d, 0x41f75713, "c.srai x14,31"},
    {0x9801, 0xfe047413, "c.andi x8,-32"},
    {0x8bd5, 0x0157f793, "c.andi x15,21"},
    {0x8c1d, 0x40f40433, "c.sub x8,x15"},
    {0x8cb9, 0x00e4c4b3, "c.xor x9,x14"},
    {0x8d55, 0x00d56533, "c.or x10,x13"},
    {0x8fe1, 0x0087f7b3, "c.and x15,x8"},
    {0xd001, 0xf00400e3, "c.beqz x8,.-256"},
    {0xcffd, 0x0e078f63, "c.beqz x15,.+254"},
    {0xc4cd, 0x0a048563, "c.beqz x9,.+170"},
    {0xe831, 0x04041a63, "c.bnez x8,.+84"},
    {0xfe7d, 0xfe061fe3, "c.bnez x12,.-2"},
    {0x0086, 0x00109093, "c.slli x1,1"},
    {0x0ffe, 0x01ff9f93, "c.slli x31,31"},
    {0x4082, 0x00012083, "c.lwsp x1,0(sp)"},
    {0x5ffe, 0x0fc12f83, "c.lwsp x31,252(sp)"},
    {0x4456, 0x05412403, "c.lwsp x8,84(sp)"},
    {0x54aa, 0x0a812483, "c.lwsp x9,168(sp)"},
    {0x8082, 0x00008067, "c.jr x1"},
    {0x8f82, 0x000f8067, "c.jr x31"},
    {0x80fe, 0x01f000b3, "c.mv x1,x31"},
    {0x8f86, 0x00100fb3, "c.mv x31,x1"},
    {0x9002, 0x00100073, "c.ebreak"},
    {0x9282, 0x000280e7, "c.jalr x5"},
    {0x90fe, 0x01f080b3, "c.add x1,x31"},
    {0x9f8a, 0x002f8fb3, "c.add x31,x2"},
    {0xc002, 0x00012023, "c.swsp x0,0(sp)"},
    {0xdffe, 0x0ff12e23, "c.swsp x31,252(sp)"},
    {0xcaa2, 0x04812a23, "c.swsp x8,84(sp)"},
    {0xd526, 0x0a912423, "c.swsp x9,168(sp)"},
};

static void each_is_the_instruction_of_32_bits(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        const uint32_t is = riscv_expand(pairs[i].code);
        if (is != pairs[i].whole) {
            fail_msg("%s: %08x, not %08x", pairs[i].text, (unsigned)is, (unsigned)pairs[i].whole);
        }
    }
}

/* Reserved: immediates and registers of 0, shifts of 32 and more; floating point, and arithmetic of RV64. */
static void codes_that_rv32_does_not_have_are_none(void **state)
{
    static const uint16_t codes[] = {0x0000, 0x0004, 0x001c, 0x2000, 0x6000, 0x8000, 0xa000, 0xe000,
                                     0x6081, 0x6001, 0x9001, 0x9401, 0x9c01, 0x9c21, 0x9c41, 0x9c61,
                                     0x1082, 0x4002, 0x4012, 0x8002, 0x2002, 0x6002, 0xa002, 0xe002};
    (void)state;
    for (size_t i = 0; i < sizeof codes / sizeof codes[0]; i++) {
        if (riscv_expand(codes[i]) != 0) {
            fail_msg("%04x: %08x", (unsigned)codes[i], (unsigned)riscv_expand(codes[i]));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_the_instruction_of_32_bits),
        cmocka_unit_test(codes_that_rv32_does_not_have_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
