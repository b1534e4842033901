"""Reports and leaderboards: folders of static pages made from run folders."""

from memorymaze.runs.report.site_report import REPORT_MARK, write_report
from memorymaze.runs.report.sources import read_sources

__all__ = ["REPORT_MARK", "read_sources", "write_report"]
