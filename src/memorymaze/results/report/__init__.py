"""Reports and leaderboards: folders of static pages made from run folders."""

from memorymaze.results.report.site_report import write_report
from memorymaze.results.report.sources import read_sources

__all__ = ["read_sources", "write_report"]
