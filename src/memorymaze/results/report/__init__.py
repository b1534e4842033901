"""Reports and leaderboards: folders of static pages made from run folders."""

from memorymaze.results.report.site_report import check_out, write_report
from memorymaze.results.report.sources import read_sources

__all__ = ["check_out", "read_sources", "write_report"]
