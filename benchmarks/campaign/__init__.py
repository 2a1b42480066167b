"""Campaigns of random mechanisms through the engine; `benchmarks.bench_accuracy` prints what they find."""
