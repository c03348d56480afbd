/* Where the emulated Cortex-M4 begins: it switches its floating point on, and goes on with the C
   library's start. */
#include <stdint.h>

extern void _start(void);

static void reset(void) {
    *(volatile uint32_t *)0xE000ED88 |= 0xFu << 20;
    __asm volatile("dsb\n\tisb");
    _start();
}

__attribute__((section(".vectors"), used)) void (*const VECTORS[16])(void) = {
    (void (*)(void))0x20040000,
    reset,
};
