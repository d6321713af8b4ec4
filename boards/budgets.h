/*
 * budgets: the memory of microcontroller kits. A board names its line; board.h explains the two members.
 *
 * An image takes at most image_ram: 60 % of the chip's RAM, so that a program has room beside it; with two cores more,
 * for the next frame's scene and more code. What code in RAM, stack and variables take is up to the link. scene_bytes
 * is what is left then, in steps of 512 bytes, less a reserve into which code may grow: 3,072 bytes where it runs from
 * RAM, else 768. `make budgets` calculates it again.
 */
#ifndef BUDGETS_H
#define BUDGETS_H

#define BUDGET_RP2040    .image_ram = {162201, 240640}, .scene_bytes = 213 * 512
#define BUDGET_RP2350    .image_ram = {319488, 379904}, .scene_bytes = 295 * 512
#define BUDGET_STM32F405 .image_ram = {117964}, .scene_bytes = 210 * 512
#define BUDGET_LM3S6965  .image_ram = {39321}, .scene_bytes = 58 * 512

#endif
