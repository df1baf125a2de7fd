/* Prints the hashes of all scenes, as the Rust program does without names. */
#include <stdint.h>
#include <stdio.h>

uint32_t fingerprint_scenes(void);
uint32_t fingerprint_half(uint32_t number, uint32_t upper);

int main(void) {
    for (uint32_t number = 0; number < fingerprint_scenes(); number++) {
        uint32_t upper = fingerprint_half(number, 1), lower = fingerprint_half(number, 0);
        printf("%u %08x%08x\n", (unsigned)number, (unsigned)upper, (unsigned)lower);
    }
    return 0;
}
