#pragma once

/// Has the compiler make a function several times, for plain x86-64 and for processors with 256- and 512-bit vectors,
/// and choose when the program starts. All do the same operations on the same numbers (-ffp-contract=off), so the
/// results are the same bits. Elsewhere, ARM say, a function is made once, for what every such processor has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define ROBOSIM_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ROBOSIM_VECTOR_CLONES
#endif
