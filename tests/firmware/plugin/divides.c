/* A plugin of QEMU (API 1, no header needed) that counts divisions: instructions that divide, and calls of the
 * functions that do it on cores without them. Whenever the program passes a marked place, the count so far becomes a
 * line of a file.
 *
 *     cc -O2 -shared -fPIC -o divides.so divides.c
 *     qemu-system-arm ... -plugin file=divides.so,out=FILE,mark=ADDRESS,function=ADDRESS,function=...
 *
 * Addresses are hexadecimal. `cargo xtask firmware` and `trade` call both. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t plugin_id;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef struct {
    const char *target_name;
} machine_info;
enum { NO_REGISTERS = 0, ADD_U64 = 0 };

extern void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id, void (*)(plugin_id, struct qemu_plugin_tb *));
extern void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *, void (*)(unsigned, void *), int, void *);
extern void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *, int, void *, uint64_t);
extern void qemu_plugin_register_atexit_cb(plugin_id, void (*)(plugin_id, void *), void *);
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
extern struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
extern const void *qemu_plugin_insn_data(const struct qemu_plugin_insn *);
extern size_t qemu_plugin_insn_size(const struct qemu_plugin_insn *);
extern uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

enum { MOST_FUNCTIONS = 64 };
static uint64_t divides, mark, functions[MOST_FUNCTIONS];
static int function_count, riscv;
static FILE *out;

/* Whether an instruction divides: div, divu, rem and remu of RISC-V; sdiv, udiv and vdiv of Arm's Thumb. QEMU appends
 * two bytes of the next instruction to the last but one of a page, so only the first four are told, and the size is at
 * least theirs. */
static int divides_itself(const uint8_t *bytes, size_t size) {
    uint32_t first, second;
    if (size < 4) return 0;
    first = bytes[0] | bytes[1] << 8;
    second = bytes[2] | bytes[3] << 8;
    if (riscv) {
        uint32_t word = first | second << 16;
        return (word & 0xfe00407f) == 0x02004033;
    }
    return (first & 0xffd0) == 0xfb90 || ((first & 0xffb0) == 0xee80 && (second & 0x0e50) == 0x0a00);
}

static int is_function(uint64_t address) {
    int k;
    for (k = 0; k < function_count; k++)
        if (functions[k] == address) return 1;
    return 0;
}

static void on_mark(unsigned cpu, void *data) {
    (void)cpu, (void)data;
    fprintf(out, "%llu\n", (unsigned long long)divides);
}

static void on_block(plugin_id id, struct qemu_plugin_tb *block) {
    size_t count = qemu_plugin_tb_n_insns(block), k;
    (void)id;
    for (k = 0; k < count; k++) {
        struct qemu_plugin_insn *instruction = qemu_plugin_tb_get_insn(block, k);
        uint64_t address = qemu_plugin_insn_vaddr(instruction);
        if (is_function(address) || divides_itself(qemu_plugin_insn_data(instruction), qemu_plugin_insn_size(instruction)))
            qemu_plugin_register_vcpu_insn_exec_inline(instruction, ADD_U64, &divides, 1);
        if (address == mark) qemu_plugin_register_vcpu_insn_exec_cb(instruction, on_mark, NO_REGISTERS, 0);
    }
}

static void on_end(plugin_id id, void *data) {
    (void)id, (void)data;
    fclose(out);
}

__attribute__((visibility("default"))) int qemu_plugin_install(plugin_id id, const machine_info *info, int count,
                                                               char **arguments) {
    int k;
    riscv = !strncmp(info->target_name, "riscv", 5);
    for (k = 0; k < count; k++) {
        if (!strncmp(arguments[k], "out=", 4)) out = fopen(arguments[k] + 4, "w");
        if (!strncmp(arguments[k], "mark=", 5)) mark = strtoull(arguments[k] + 5, 0, 16);
        if (!strncmp(arguments[k], "function=", 9) && function_count < MOST_FUNCTIONS)
            functions[function_count++] = strtoull(arguments[k] + 9, 0, 16);
    }
    if (!out) return 1;
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_block);
    qemu_plugin_register_atexit_cb(id, on_end, 0);
    return 0;
}
