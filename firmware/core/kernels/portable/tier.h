/*
 * tier: says beside a function how much its speed matters, so that an image for a chip with slow flash can run it from
 * RAM. A target that asks for it (-DCODE_TIERS) finds the function, or a constant table, in a section .tier.TIER.*, of
 * which its linker script gathers what the image has RAM for. Elsewhere the macro is nothing. A copy of the function
 * that the compiler makes stays in the section.
 *
 *   loop     per pixel and row, and the assembly that steps over vertices and triangles
 *   mesh     per vertex, joint or triangle of every mesh
 *   figure   per triangle of a textured, animated figure; the second core's share of the work
 *   scenery  large triangles, textures in perspective, vertices in the general case, lines, text
 *   few      triangles that are cut, divided or bent: few of a frame
 *   seldom   once a frame or rarer, or what few programs use: it stays in flash, even where RAM is plenty
 *   (none)   once a frame or mesh; an image may have such code where it likes
 */
#ifndef PH_TIER_H
#define PH_TIER_H

#ifdef CODE_TIERS
#define PH_TIER(tier)            PH_TIER_SECTION(tier, __COUNTER__)
#define PH_TIER_SECTION(tier, n) PH_TIER_NAMED(tier, n)
#define PH_TIER_NAMED(tier, n)   __attribute__((section(".tier." #tier "." #n)))
#else
#define PH_TIER(tier)
#endif

#endif
