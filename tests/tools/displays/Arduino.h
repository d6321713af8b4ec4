/* A stand-in of the few calls of Arduino that the sketches take. */
#pragma once
#include "stand_in.h"

enum { OUTPUT = 1, HIGH = 1 };
static struct {
    void begin(long)
    {
    }
    void println(int status)
    {
        exit(status != 0);
    }
} Serial;
static inline void delay(unsigned long)
{
}
static inline void pinMode(int, int)
{
}
static inline void digitalWrite(int, int)
{
}
void setup();
void loop();
int main()
{
    for (setup();;) {
        loop();
    }
}
