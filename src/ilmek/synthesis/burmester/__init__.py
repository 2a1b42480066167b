"""Motion generation by Burmester's theory: links that guide a body through given poses."""
