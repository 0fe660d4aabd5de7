"""What pbreport study is made of: the settings to choose, and the diagrams."""
