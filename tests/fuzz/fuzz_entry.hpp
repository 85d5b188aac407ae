// FUZZ_ENTRY(name): what the function of the target <name>_fuzz.cpp is called: as libFuzzer wants it, or, in
// fuzz_corpus, which has all targets, by its name.
#pragma once

#ifdef OUTRIDER_FUZZ
#define FUZZ_ENTRY(name) LLVMFuzzerTestOneInput
#else
#define FUZZ_ENTRY(name) fuzz_##name
#endif
