/*
 * lab_search: the longest stretch that a format cannot order. Two distances i < j are ordered wrongly if the code of j
 * is not below that of i. All lengths are in LSBs of Q16.16. The smallest separation that is ordered right is one more
 * than the largest j - i that is ordered wrongly: on a plateau of equal codes, the number of its distances.
 */
#ifndef LAB_SEARCH_H
#define LAB_SEARCH_H

#include "lab_probe.h"

#define LAB_BLOCKS 1024
#define LAB_PARTS  64

/* What is known of a format that is not monotone: the extreme codes of each block of its range. */
struct lab_search {
    uint32_t size; /* of a block, in LSBs */
    uint32_t least[LAB_BLOCKS], most[LAB_BLOCKS];
    uint32_t suffix[LAB_PARTS]; /* of one block: the largest code from each part on */
};

/* Reads the whole range once if the format is not monotone. */
void lab_search_open(struct lab_search *s, struct lab_probe *p);

/*
 * S_eff at z: the longest over all pairs i <= z <= j. In a monotone format it is the plateau on which z lies, or its
 * neighbour if that is longer because the near or the far plane cuts the plateau.
 */
uint32_t lab_search_at(struct lab_search *s, struct lab_probe *p, fx_t z);

/* S_worst: the longest over all pairs. */
uint32_t lab_search_worst(struct lab_search *s, struct lab_probe *p);

#endif
