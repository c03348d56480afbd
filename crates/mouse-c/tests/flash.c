/* Links every function of the library and nothing else, to measure its code and constants. */
#include "tolman_mouse.h"

void *all(int number) {
    void *functions[] = {
        (void *)tolman_new,          (void *)tolman_arrive, (void *)tolman_crashed,
        (void *)tolman_carried_back, (void *)tolman_run,    (void *)tolman_save,
        (void *)tolman_load,
    };
    return functions[number];
}
