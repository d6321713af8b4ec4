/* See option_camera.h. The keys in the value say which textbook's camera is meant; a mixture of two is refused. */
#include "option_camera.h"

#include "camera.h"
#include "option_text.h"

#include <string.h>

enum { EYE, TARGET, UP, VRP, VPN, VUP, YPR, QUAT, KEYS };

static const struct {
    char name[8];
    int numbers;
} keys[KEYS] = {{"eye=", 3}, {"target=", 3}, {"up=", 3},  {"vrp=", 3},
                {"vpn=", 3}, {"vup=", 3},    {"ypr=", 3}, {"quat=", 4}};

/* The keys that a way of stating a view needs, and those that it may have. */
static const struct {
    unsigned needs, takes;
} ways[] = {{1 << EYE, 1 << EYE | 1 << TARGET | 1 << UP},
            {1 << VRP | 1 << VPN, 1 << VRP | 1 << VPN | 1 << VUP},
            {1 << YPR, 1 << YPR | 1 << EYE},
            {1 << QUAT, 1 << QUAT | 1 << EYE}};

static int key_at(const char *text)
{
    int key = 0;
    while (key < KEYS && strncmp(text, keys[key].name, strlen(keys[key].name)) != 0) {
        key++;
    }
    return key;
}

/* Returns the set of the keys that were read, or 0. */
static unsigned read_keys(const char *text, fx_t values[KEYS][4])
{
    unsigned seen = 0;
    for (;;) {
        const int key = key_at(text);
        if (key == KEYS || (seen >> key & 1) != 0 ||
            !option_text_fx_list(text + strlen(keys[key].name), values[key], keys[key].numbers, &text)) {
            return 0;
        }
        seen |= 1u << key;
        if (*text++ != ',') {
            return text[-1] == '\0' ? seen : 0;
        }
    }
}

static struct fx_vec3 vec3(const fx_t v[4])
{
    return (struct fx_vec3){v[0], v[1], v[2]};
}

static struct ph_xform view_of(unsigned seen, fx_t v[KEYS][4])
{
    if ((seen & 1 << VRP) != 0) {
        return ph_view_phigs(vec3(v[VRP]), vec3(v[VPN]), vec3(v[VUP]));
    }
    if ((seen & 1 << YPR) != 0) {
        return ph_view_yaw_pitch_roll(vec3(v[EYE]), fx_turn32_from_deg(v[YPR][0]), fx_turn32_from_deg(v[YPR][1]),
                                      fx_turn32_from_deg(v[YPR][2]));
    }
    if ((seen & 1 << QUAT) != 0) {
        const fx_t *const q = v[QUAT];
        return ph_view_quat(fx_quat_normalise((struct fx_quat){q[0], q[1], q[2], q[3]}), vec3(v[EYE]));
    }
    return ph_view_look_at(vec3(v[EYE]), vec3(v[TARGET]), vec3(v[UP]));
}

bool option_camera_read(const char *text, struct option_camera *out)
{
    fx_t v[KEYS][4] = {[UP] = {0, FX_ONE}, [VUP] = {0, FX_ONE}};
    const unsigned seen = read_keys(text, v);
    const fx_t *const q = v[QUAT];
    bool known = false;
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        known = known || ((seen & ways[i].needs) == ways[i].needs && (seen & ~ways[i].takes) == 0);
    }
    if (!known || ((seen & 1 << QUAT) != 0 && (q[0] | q[1] | q[2] | q[3]) == 0)) {
        return false;
    }
    const bool look_at = (seen & ~ways[0].takes) == 0;
    const fx_t distance = look_at ? fx_vec3_length_sat(fx_vec3_sub_sat(vec3(v[EYE]), vec3(v[TARGET]))) : FX_INT(3);
    *out = (struct option_camera){true, view_of(seen, v), distance};
    return true;
}
