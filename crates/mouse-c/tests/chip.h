/* What the library needs of the emulated Cortex-M4: instructions of the longest call, and bytes of
   the stack. An instruction takes 16 ns there, and the timer ticks at 25 MHz. */
#include <stdint.h>

#define RELOAD (*(volatile uint32_t *)0xE000E014)
#define CURRENT (*(volatile uint32_t *)0xE000E018)
#define CONTROL (*(volatile uint32_t *)0xE000E010)

/* Bytes below the caller's stack that are watched, and what lies there before a call. */
#define WATCHED 24576
#define PAINT 0xCAFEF00Du

static uint32_t worst_arrive, worst_other, stack_bytes;

static inline volatile uint32_t *stack_end(void) {
    uint32_t end;
    __asm volatile("mov %0, sp" : "=r"(end));
    return (volatile uint32_t *)end;
}

/* A call's own registers may lie just below the stack's end. */
#define MEASURED(worst, call)                                                                      \
    do {                                                                                           \
        volatile uint32_t *end = stack_end();                                                      \
        for (int word = 1; word <= WATCHED / 4; word++) end[-word] = PAINT;                        \
        RELOAD = 0xFFFFFF;                                                                         \
        CONTROL = 5;                                                                               \
        CURRENT = 0;                                                                               \
        call;                                                                                      \
        uint32_t instructions = (0xFFFFFF - CURRENT) / 2 * 5;                                      \
        if (instructions > worst_##worst) worst_##worst = instructions;                            \
        int painted = WATCHED / 4;                                                                 \
        while (painted > 0 && end[-painted] == PAINT) painted--;                                   \
        if (painted * 4u > stack_bytes) stack_bytes = painted * 4u;                                \
    } while (0)
