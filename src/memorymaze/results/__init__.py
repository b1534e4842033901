"""What is made of finished runs: tables, comparisons, reports, replays, leaderboards."""
