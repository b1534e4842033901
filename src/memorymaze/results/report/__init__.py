"""Reports and leaderboards: folders of static pages made from run folders."""

from memorymaze.results.report.site_report import REPORT_MARK, write_report
from memorymaze.results.report.sources import read_sources

__all__ = ["REPORT_MARK", "read_sources", "write_report"]
