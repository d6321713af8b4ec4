/* list: a reference as the kernels know it; the small profile keeps no list. It stands in place of render/list.h. */
#ifndef PH_LIST_H
#define PH_LIST_H

#include "triangle.h"

struct ph_ref {
    uint16_t corner[3], link;
};

#endif
