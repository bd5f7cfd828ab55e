# SPDX-License-Identifier: Apache-2.0
"""What report.py and the tools beside it share: raw data in, Markdown and SVG out."""
