/* What the sketch takes of Arduino's core, to be compiled by `cargo xtask c` without it. */
#include <stddef.h>
#include <stdint.h>

enum { LOW, HIGH };
enum { A0 = 14, A1, A2 };

int analogRead(int pin);
void analogWrite(int pin, int value);
void digitalWrite(int pin, int value);
void delay(unsigned long ms);

struct Port {
    void begin(unsigned long baud);
    void println(const char *text);
    void println(unsigned long number);
};
extern Port Serial;
