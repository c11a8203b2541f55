"""Parts of bench_report: one module per kind of measurement, each with report(stem, data, plots)."""
